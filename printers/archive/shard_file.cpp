// Format of a shard: a line of description, then each layer after its index, size and checksum.
#include "printers/archive/shard_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>

#include "engine/base/json_depth.h"
#include "printers/archive/json_number.h"
#include "printers/archive/unfinished_file.h"
#include "printers/common/carried_layers.h"

namespace lamella {
namespace {

constexpr std::string_view shard_magic = "lamella shard 1 ";
constexpr std::size_t longest_line = 1 << 16;

struct RecordHead {
    std::uint64_t size;
    std::uint32_t layer;
    std::uint32_t crc;
};

std::uint32_t checksum(const std::string& bytes) {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): zlib's idea of bytes
    return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

class ShardWriter : public Backend {
  public:
    ShardWriter(std::unique_ptr<Backend> renderer, const std::filesystem::path& path, std::string settings,
                bool force)
        : renderer_(std::move(renderer)), settings_(std::move(settings)), output_(path, force) {}

    int open(const Job& job, LayerRange range, bool resume) override {
        renderer_->open(job, range, false);
        const JobStamp stamp{job.identity, settings_, range};
        const int next = output_.begin(stamp, resume);
        if (!output_.resumed())
            output_.commit(fmt::format("{}{}\n", shard_magic, to_json(stamp).dump()), next);
        return next;
    }
    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        return renderer_->render(layer);
    }
    void write(const Layer& layer, LayerProduct& product) override {
        const std::string bytes = pack(product);
        const RecordHead head{bytes.size(), static_cast<std::uint32_t>(layer.index()), checksum(bytes)};
        std::string record(sizeof head, '\0');
        std::memcpy(record.data(), &head, sizeof head);
        output_.commit(record + bytes, layer.index() + 1);
    }
    void finish() override { output_.end(""); }

  private:
    std::unique_ptr<Backend> renderer_;
    std::string settings_;
    UnfinishedFile output_;
};

}  // namespace

std::unique_ptr<Backend> make_shard_writer(std::unique_ptr<Backend> renderer,
                                           const std::filesystem::path& path, std::string settings,
                                           bool force) {
    return std::make_unique<ShardWriter>(std::move(renderer), path, std::move(settings), force);
}

ShardFile::ShardFile(std::filesystem::path path) : path_(std::move(path)), file_(path_, std::ios::binary) {
    std::error_code ignored;
    if (!file_ || std::filesystem::is_directory(path_, ignored)) refuse("cannot be opened");
    const std::uint64_t size = std::filesystem::file_size(path_);
    read_stamp();
    auto at = static_cast<std::uint64_t>(file_.tellg());
    for (int layer = stamp_.range.first; layer < stamp_.range.last; ++layer) {
        RecordHead head{};
        if (size - at < sizeof head) refuse(fmt::format("ends before layer {}", layer));
        char raw[sizeof head];
        file_.seekg(static_cast<std::streamoff>(at));
        file_.read(raw, sizeof raw);
        std::memcpy(&head, raw, sizeof head);
        at += sizeof head;
        if (!file_ || head.layer != static_cast<std::uint32_t>(layer) || head.size > size - at)
            refuse(fmt::format("is damaged at layer {}", layer));
        places_.push_back({at, head.size, head.crc});
        at += head.size;
    }
    if (at != size) refuse("has something behind its last layer");
}

void ShardFile::refuse(const std::string& what) const {
    throw InputError(fmt::format("{}: {}; accepted: a file that `lamella slice --shard` has finished",
                                 path_.string(), what));
}

void ShardFile::read_stamp() {
    std::string line(longest_line, '\0');
    file_.getline(line.data(), static_cast<std::streamsize>(line.size()));
    if (!file_) refuse("is no shard");
    line.resize(std::strlen(line.c_str()));
    if (!line.starts_with(shard_magic)) refuse("is no shard");
    try {
        const auto json =
            nlohmann::ordered_json::parse(shallow_json(std::string_view(line).substr(shard_magic.size())));
        stamp_.identity = json.at("identity").get<std::string>();
        stamp_.settings = json.at("settings").get<std::string>();
        stamp_.range = {whole_number<int>(json.at("first_layer")), whole_number<int>(json.at("last_layer"))};
    } catch (const nlohmann::json::exception&) {
        refuse("has a damaged first line");
    }
    constexpr int max_layers = 10'000'000;
    if (stamp_.range.first < 0 || stamp_.range.last <= stamp_.range.first || stamp_.range.last > max_layers)
        refuse("has a range of layers that is none");
}

std::string ShardFile::layer(int index) const {
    const Place& place = places_.at(static_cast<std::size_t>(index - stamp_.range.first));
    std::string bytes(static_cast<std::size_t>(place.size), '\0');
    {
        const std::lock_guard lock(reading_);
        file_.seekg(static_cast<std::streamoff>(place.at));
        file_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        if (!file_) refuse(fmt::format("cannot be read at layer {}", index));
    }
    if (checksum(bytes) != place.crc) refuse(fmt::format("is damaged in layer {}", index));
    return bytes;
}

std::vector<std::unique_ptr<ShardFile>> open_shards(const std::vector<std::string>& paths,
                                                    const JobStamp& wanted) {
    std::vector<std::unique_ptr<ShardFile>> shards;
    for (const std::string& path : paths) {
        shards.push_back(std::make_unique<ShardFile>(path));
        const JobStamp& found = shards.back()->stamp();
        if (found.identity != wanted.identity)
            throw InputError(path + " is of another job: its recipe, machine or inputs differ from now");
        if (found.settings != wanted.settings) {
            throw InputError(path +
                             " was made for other outputs or printer settings; accepted: the same -o and "
                             "printer as for the shards");
        }
    }
    std::ranges::sort(shards, {}, [](const auto& shard) { return shard->stamp().range.first; });
    int next = wanted.range.first;
    for (const auto& shard : shards) {
        const LayerRange& range = shard->stamp().range;
        if (range.first > next)
            throw InputError(fmt::format("layers {}:{} are in none of the shards", next, range.first));
        if (range.first < next)
            throw InputError(fmt::format("{}: layers {}:{} are in another shard, too", shard->path().string(),
                                         range.first, std::min(next, range.last)));
        next = range.last;
    }
    if (next < wanted.range.last)
        throw InputError(fmt::format("layers {}:{} are in none of the shards", next, wanted.range.last));
    if (next > wanted.range.last)
        throw InputError(
            fmt::format("the shards go on to layer {}; the job has {}", next, wanted.range.last));
    return shards;
}

}  // namespace lamella
