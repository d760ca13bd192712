// Lists of numbers, each behind its length.
#include "recipe/structure/stopped_search.h"

#include <array>
#include <fstream>
#include <system_error>
#include <type_traits>

#include "engine/base/complete_file.h"

namespace lamella {

namespace {

constexpr std::array<char, 16> magic{"lamella search2"};

/// Writes what is visited.
struct Writer {
    std::ostream& out;

    template <typename T>
    void operator()(const std::vector<T>& list) const {
        static_assert(std::is_trivially_copyable_v<T>);
        (*this)(static_cast<std::uint64_t>(list.size()));
        out.write(reinterpret_cast<const char*>(list.data()),
                  static_cast<std::streamsize>(list.size() * sizeof(T)));
    }
    template <typename T>
    requires std::is_arithmetic_v<T>
    void operator()(T number) const { out.write(reinterpret_cast<const char*>(&number), sizeof number); }
};

/// Fills what is visited from the rest of a file; `fails` once something is missing.
struct Reader {
    std::ifstream& in;
    std::uint64_t left;
    bool fails = false;

    template <typename T>
    void operator()(std::vector<T>& list) {
        std::uint64_t count = 0;
        (*this)(count);
        if (fails || count > left / sizeof(T)) {
            fails = true;
            return;
        }
        list.resize(count);
        take(list.data(), count * sizeof(T));
    }
    template <typename T>
    requires std::is_arithmetic_v<T>
    void operator()(T& number) { take(&number, sizeof number); }

  private:
    void take(void* to, std::uint64_t bytes) {
        if (fails || bytes > left || !in.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes))) {
            fails = true;
            return;
        }
        left -= bytes;
    }
};

/// Visits every number of a search, in the order of the file.
template <typename Search, typename Visit>
void visit_all(Search& search, Visit& visit) {
    auto& state = search.state;
    visit(state.design);
    visit(state.mma.steps);
    visit(state.mma.former);
    visit(state.mma.before);
    visit(state.mma.asymptotes.low);
    visit(state.mma.asymptotes.upp);
    visit(state.iteration);
    visit(state.phase);
    visit(state.phase_began);
    visit(state.first_compliance);
    visit(state.volume);
    visit(search.history);
}

}  // namespace

void write_search(const std::filesystem::path& file, const StoppedSearch& search) {
    write_complete_file(file, [&](std::ostream& out) {
        out.write(magic.data(), magic.size());
        const Writer writer{out};
        visit_all(search, writer);
        writer(static_cast<std::uint64_t>(search.state.displacements.size()));
        for (const std::vector<double>& along : search.state.displacements) writer(along);
    });
}

std::optional<StoppedSearch> read_search(const std::filesystem::path& file) {
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(file, error);
    if (error || size < magic.size()) return std::nullopt;
    std::ifstream in(file, std::ios::binary);
    std::array<char, magic.size()> begins{};
    if (!in.read(begins.data(), begins.size()) || begins != magic) return std::nullopt;
    StoppedSearch search;
    Reader reader{in, size - magic.size()};
    visit_all(search, reader);
    std::uint64_t lists = 0;
    reader(lists);
    for (std::uint64_t i = 0; i < lists && !reader.fails; ++i)
        reader(search.state.displacements.emplace_back());
    if (reader.fails || reader.left > 0) return std::nullopt;
    return search;
}

}  // namespace lamella
