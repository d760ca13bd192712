// Answers requests through the C interface; its statuses and messages go into the replies.
#include "app/reports/section_server.h"

#include <fmt/format.h>

#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/json_depth.h"

namespace lamella {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t max_jobs = 1024;

template <typename T>
T sized() {
    T value{};
    value.struct_size = sizeof value;
    return value;
}

/// A failure whose details the context has.
struct Failed {
    std::int32_t status;
};

[[noreturn]] void refuse(const std::string& what) { throw InputError(what); }

/// Returns a member of a request, or `usual` when it is absent.
template <typename T>
T member(const Json& request, const char* key, const char* kind, std::optional<T> usual = {}) {
    const auto found = request.find(key);
    if (found == request.end()) {
        if (usual) return *usual;
        refuse(fmt::format("{}: missing; accepted: {}", key, kind));
    }
    try {
        const bool is_text = std::is_same_v<T, std::string>;
        if (found->is_string() != is_text || found->is_boolean() || found->is_null())
            refuse(fmt::format("{}: {} is not a {}", key, found->dump(), kind));
        if constexpr (std::is_integral_v<T>) {
            if (!found->is_number_integer())
                refuse(fmt::format("{}: {} is not a {}", key, found->dump(), kind));
            // get() would cut off the digits that do not fit.
            const bool fits = found->is_number_unsigned() ? std::in_range<T>(found->get<std::uint64_t>())
                                                          : std::in_range<T>(found->get<std::int64_t>());
            if (!fits) {
                refuse(fmt::format("{}: {} is out of range; accepted: {} to {}", key, found->dump(),
                                   std::numeric_limits<T>::min(), std::numeric_limits<T>::max()));
            }
        }
        return found->get<T>();
    } catch (const nlohmann::json::exception&) {
        refuse(fmt::format("{}: is not a {}", key, kind));
    }
}

std::int32_t what_of(const Json& request) {
    const auto what = member<std::string>(request, "what", "text", "part");
    if (what == "part") return LAMELLA_PART;
    if (what == "supports") return LAMELLA_SUPPORTS;
    if (what == "both") return LAMELLA_PART | LAMELLA_SUPPORTS;
    refuse(fmt::format("what: \"{}\" is unknown; accepted: part, supports, both", what));
}

lamella_raster raster_of(const Json& request) {
    auto raster = sized<lamella_raster>();
    raster.columns = member<std::int32_t>(request, "columns", "whole number");
    raster.rows = member<std::int32_t>(request, "rows", "whole number");
    raster.lines = member<std::int32_t>(request, "lines", "whole number", 4);
    raster.x = member<double>(request, "x", "number");
    raster.y = member<double>(request, "y", "number");
    raster.pitch_x = member<double>(request, "pitch_x", "number");
    raster.pitch_y = member<double>(request, "pitch_y", "number", raster.pitch_x);
    return raster;
}

/// Appends numbers in the byte format of replies.
template <typename T, typename Number>
void append(std::string& bytes, std::span<const Number> numbers) {
    for (const Number number : numbers) {
        const T value = static_cast<T>(number);
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);  // NOLINT: little-endian, as every machine that this runs on
        bytes.append(raw, sizeof value);
    }
}

/// Polygons from lists of points, two numbers each.
struct Polygons {
    explicit Polygons(const Json& lists) {
        if (!lists.is_array()) refuse("polygons: is not a list; accepted: a list of [x, y, x, y, ...] lists");
        for (const Json& list : lists) {
            if (!list.is_array() || list.size() % 2 != 0)
                refuse("polygons: a polygon is not a list of x and y; accepted: [x, y, x, y, ...]");
            for (const Json& number : list) {
                if (!number.is_number()) refuse("polygons: a coordinate is not a number");
                points.push_back(number.get<double>());
            }
            first.push_back(points.size() / 2);
        }
    }
    lamella_polygons view() const {
        auto view = sized<lamella_polygons>();
        view.count = first.size() - 1;
        view.first = first.data();
        view.points = points.data();
        return view;
    }

    std::vector<double> points;
    std::vector<std::size_t> first{0};
};

}  // namespace

SectionServer::SectionServer() {
    if (lamella_context_create(LAMELLA_ABI_VERSION, &context_) != LAMELLA_OK) throw std::bad_alloc();
}

SectionServer::~SectionServer() {
    for (const auto& [number, job] : jobs_) lamella_job_destroy(job);
    lamella_context_destroy(context_);
}

void SectionServer::check(std::int32_t status) const {
    if (status != LAMELLA_OK) throw Failed{status};
}

ServerReply SectionServer::answer(const std::string& text) {
    Json id = nullptr;
    ServerReply reply;
    const auto fail = [&](std::int32_t status, const std::string& message) {
        reply = {{{"ok", false}, {"status", status}, {"message", message}}, ""};
    };
    try {
        if (shallow_json(text).empty() && !text.empty())
            refuse(
                fmt::format("the request is nested too deep; accepted: up to {} lists and objects in each "
                            "other",
                            deepest_json));
        const Json request = Json::parse(text);
        if (!request.is_object()) refuse("the request is not an object; accepted: {\"method\": ...}");
        if (request.contains("id")) id = request["id"];
        reply = answer(request);
        reply.head["ok"] = true;
    } catch (const Failed& failed) {
        auto error = sized<lamella_error>();
        lamella_last_error(context_, &error);
        fail(failed.status, error.message);
        if (error.line > 0) reply.head.update({{"path", error.path}, {"line", error.line}});
    } catch (const nlohmann::json::exception& error) {
        fail(LAMELLA_BAD_INPUT, std::string("the request is not valid JSON: ") + error.what());
    } catch (const Error& error) {
        fail(error.exit_code(), error.what());
    } catch (const std::bad_alloc&) {
        fail(LAMELLA_OUT_OF_MEMORY, "there is not enough memory");
    }
    reply.head["id"] = id;
    reply.head["bytes"] = reply.body.size();
    return reply;
}

ServerReply SectionServer::answer(const Json& request) {
    const auto method = member<std::string>(request, "method", "text");
    if (method == "open") return open(request);
    if (method == "close") return close(request);
    if (method == "run") return run(request);
    if (method == "contours" || method == "fill" || method == "coverage" || method == "runs")
        return cut(request);
    if (method == "end") {
        ended_ = true;
        return {};
    }
    refuse(
        fmt::format("method: \"{}\" is unknown; accepted: open, close, contours, fill, coverage, runs, run, "
                    "end",
                    method));
}

ServerReply SectionServer::open(const Json& request) {
    if (static_cast<std::int64_t>(jobs_.size()) >= max_jobs)
        refuse(fmt::format("{} jobs are already open; accepted: close one first", max_jobs));
    lamella_recipe* recipe = nullptr;
    const auto path = member<std::string>(request, "recipe", "path", "");
    check(path.empty() ? lamella_recipe_create(context_, &recipe)
                       : lamella_recipe_read(context_, path.c_str(), &recipe));
    const std::unique_ptr<lamella_recipe, decltype(&lamella_recipe_destroy)> held(recipe,
                                                                                  lamella_recipe_destroy);
    check(lamella_recipe_add_printers(context_, recipe, nullptr));
    const auto text = member<std::string>(request, "text", "recipe's text", ""),
               name = member<std::string>(request, "name", "text", "request.toml");
    if (!text.empty())
        check(lamella_recipe_add_text(context_, recipe, text.data(), text.size(), name.c_str()));
    const Json set = request.value("set", Json::object());
    if (!set.is_object()) refuse("set: is not an object; accepted: {\"section.key\": value, ...}");
    for (const auto& [key, value] : set.items()) {
        const std::string word = value.is_string() ? value.get<std::string>() : value.dump();
        check(lamella_recipe_set(context_, recipe, key.c_str(), word.c_str()));
    }
    lamella_job* job = nullptr;
    check(lamella_job_build(context_, recipe, nullptr, &job));
    jobs_[next_job_] = job;
    auto info = sized<lamella_job_info>();
    check(lamella_job_info_get(context_, job, &info));
    return {{{"job", next_job_++},
             {"name", info.name},
             {"identity", info.identity},
             {"layers", info.layer_count},
             {"layer_height", info.layer_height},
             {"supports", info.has_supports != 0},
             {"lower", info.lower},
             {"upper", info.upper}},
            ""};
}

lamella_job* SectionServer::job_of(const Json& request) const {
    const auto number = member<std::int64_t>(request, "job", "number of a job");
    const auto job = jobs_.find(number);
    if (job == jobs_.end())
        refuse(fmt::format("job: {} is not open; accepted: a job number from a reply to `open`", number));
    return job->second;
}

ServerReply SectionServer::close(const Json& request) {
    lamella_job_destroy(job_of(request));
    jobs_.erase(request["job"].get<std::int64_t>());
    return {};
}

ServerReply SectionServer::cut(const Json& request) {
    lamella_job* job = job_of(request);
    double z = 0;
    if (request.contains("layer")) {
        if (request.contains("z")) refuse("layer: conflicts with z; accepted: layer or z, not both");
        check(lamella_job_layer_z(context_, job, member<std::int32_t>(request, "layer", "whole number"), &z));
    } else {
        z = member<double>(request, "z", "number, mm (or layer)");
    }
    const std::int32_t what = what_of(request);
    lamella_section* section = nullptr;
    check(lamella_section_open(context_, job, z, &section));
    const std::unique_ptr<lamella_section, decltype(&lamella_section_destroy)> held(section,
                                                                                    lamella_section_destroy);
    const std::string method = request["method"];
    ServerReply reply{{{"z", z}}, ""};
    if (method == "coverage") {
        const lamella_raster raster = raster_of(request);
        constexpr std::int64_t max_pixels = std::int64_t{1} << 31;
        if (raster.columns < 1 || raster.rows < 1 ||
            static_cast<std::int64_t>(raster.columns) * raster.rows > max_pixels)
            refuse(fmt::format(
                "columns, rows: the number of pixels is out of range; accepted: 1 to {} pixels", max_pixels));
        reply.body.resize(static_cast<std::size_t>(raster.columns) * static_cast<std::size_t>(raster.rows));
        auto* pixels = reinterpret_cast<std::uint8_t*>(reply.body.data());  // NOLINT: bytes
        check(lamella_section_coverage(context_, section, what, &raster, pixels, 0));
        return reply;
    }
    if (method == "runs") {
        const lamella_raster raster = raster_of(request);
        lamella_runs* runs = nullptr;
        check(lamella_section_runs(context_, section, what, &raster, &runs));
        const std::unique_ptr<lamella_runs, decltype(&lamella_runs_destroy)> kept(runs, lamella_runs_destroy);
        auto view = sized<lamella_runs_view>();
        check(lamella_runs_view_get(context_, runs, &view));
        const std::size_t count = view.first[view.line_count];
        reply.head.update({{"lines", view.line_count}, {"runs", count}});
        append<std::uint32_t>(reply.body, std::span(view.first, view.line_count + 1));
        append<std::int32_t>(reply.body, std::span(view.ends, 2 * count));
        return reply;
    }
    const auto tolerance = member<double>(request, "tolerance", "number, mm", 0.025);
    lamella_contours* contours = nullptr;
    if (method == "fill") {
        const Polygons polygons(request.value("polygons", Json(nullptr)));
        const lamella_polygons inside = polygons.view();
        check(lamella_section_fill(context_, section, what, &inside, tolerance, &contours));
    } else {
        check(lamella_section_contours(context_, section, what, tolerance, &contours));
    }
    const std::unique_ptr<lamella_contours, decltype(&lamella_contours_destroy)> kept(
        contours, lamella_contours_destroy);
    auto view = sized<lamella_contours_view>();
    check(lamella_contours_view_get(context_, contours, &view));
    const std::size_t points = view.first[view.count];
    reply.head.update({{"contours", view.count}, {"points", points}, {"area", view.area}});
    append<std::uint32_t>(reply.body, std::span(view.first, view.count + 1));
    append<std::int32_t>(reply.body, std::span(view.parent, view.count));
    append<double>(reply.body, std::span(view.points, 2 * points));
    return reply;
}

ServerReply SectionServer::run(const Json& request) {
    lamella_job* job = job_of(request);
    const auto output = member<std::string>(request, "output", "path");
    auto options = sized<lamella_run_options>();
    if (request.value("resume", false)) options.flags |= LAMELLA_RESUME;
    if (request.value("force", false)) options.flags |= LAMELLA_FORCE;
    options.first = member<std::int32_t>(request, "first", "whole number", 0);
    options.last = member<std::int32_t>(request, "last", "whole number", 0);
    if (output == "-") refuse("output: standard output carries the replies; accepted: a file or folder");
    auto report = sized<lamella_run_report>();
    check(lamella_run(context_, job, output.c_str(), &options, &report));
    return {{{"layers", report.layers_written},
             {"kept", report.layers_kept},
             {"volume", report.volume},
             {"support_volume", report.support_volume}},
            ""};
}

}  // namespace lamella
