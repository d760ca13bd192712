// Each plan is a JSON file with a hash of its contents; reading checks every size and number.
#include "recipe/build/support_plan.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>

#include "engine/base/complete_file.h"
#include "engine/base/error.h"
#include "engine/base/json_depth.h"
#include "recipe/identity.h"

namespace lamella {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int version = 1;
constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30;
constexpr SupportReason last_reason = SupportReason::stability;

fs::path file_of(const fs::path& folder, const std::string& hash) { return folder / (hash + ".json"); }

std::string contents_hash(const Json& contents) {
    Fnv128 hash;
    hash.add(contents.dump());
    return hash.hex();
}

double number(const Json& json) {
    if (!json.is_number() || !std::isfinite(json.get<double>())) throw std::runtime_error("not a number");
    return json.get<double>();
}

std::size_t whole(const Json& json) {
    if (!json.is_number_unsigned()) throw std::runtime_error("not a whole number");
    return json.get<std::size_t>();
}

/// Reads exactly `count` finite numbers.
std::vector<double> number_row(const Json& json, std::size_t count) {
    if (!json.is_array() || json.size() != count) throw std::runtime_error("a row of the wrong length");
    std::vector<double> numbers;
    for (const Json& entry : json) numbers.push_back(number(entry));
    return numbers;
}

SupportPoint point_from(const Json& json) {
    const auto n = number_row(json, 4);
    const std::size_t reason = whole(json[3]);
    if (reason > static_cast<std::size_t>(last_reason)) throw std::runtime_error("an unknown reason");
    return {{n[0], n[1], n[2]}, static_cast<SupportReason>(reason)};
}

/// Reads the indices of unsupported points, in ascending order.
std::vector<std::size_t> unheld_from(const Json& json, std::size_t points) {
    std::vector<std::size_t> unheld;
    for (const Json& entry : json) {
        const std::size_t index = whole(entry);
        if (index >= points) throw std::runtime_error("no such point");
        if (!unheld.empty() && index <= unheld.back()) throw std::runtime_error("points out of order");
        unheld.push_back(index);
    }
    return unheld;
}

SupportPlan plan_from(const Json& json) {
    SupportPlan plan;
    const Json& survey = json.at("survey");
    plan.survey.hanging_length = number(survey.at("hanging_length_mm"));
    plan.survey.own_bridges = whole(survey.at("own_bridges"));
    plan.survey.blocked = whole(survey.at("left_out"));
    if (!survey.at("topples_at_mm").is_null()) plan.survey.topples_at = number(survey.at("topples_at_mm"));
    Scaffold& scaffold = plan.scaffold;
    for (const Json& point : json.at("points")) scaffold.points.push_back(point_from(point));
    plan.survey.points = scaffold.points;
    scaffold.unheld = unheld_from(json.at("unheld"), scaffold.points.size());
    for (const Json& bar : json.at("bars")) {
        const auto n = number_row(bar, 6);
        scaffold.bars.push_back({{n[0], n[1], n[2]}, {n[3], n[4], n[5]}});
    }
    for (const Json& pillar : json.at("pillars")) {
        const auto n = number_row(pillar, 5);
        scaffold.pillars.push_back({{n[0], n[1]}, n[2], n[3], n[4]});
    }
    for (const Json& connector : json.at("connectors")) {
        const auto n = number_row(connector, 8);
        scaffold.connectors.push_back({{n[0], n[1], n[2]}, n[3], {n[4], n[5], n[6]}, n[7]});
    }
    return plan;
}

}  // namespace

fs::path default_plan_folder() {
    // The XDG specification says to ignore relative paths, so that no files are scattered over working
    // folders.
    const auto folder = [](const char* name) {
        const char* value = std::getenv(name);
        const fs::path path = value ? value : "";
        return path.is_absolute() ? path : fs::path();
    };
    if (const fs::path cache = folder("XDG_CACHE_HOME"); !cache.empty()) return cache / "lamella/plans";
    if (const fs::path home = folder("HOME"); !home.empty()) return home / ".cache/lamella/plans";
    return {};
}

Json plan_json(const SupportPlan& plan) {
    const Scaffold& scaffold = plan.scaffold;
    Json points = Json::array(), bars = Json::array(), pillars = Json::array(), connectors = Json::array();
    for (const SupportPoint& p : scaffold.points) {
        points.push_back({p.at.x, p.at.y, p.at.z, static_cast<int>(p.reason)});
    }
    for (const ScaffoldBar& b : scaffold.bars) bars.push_back({b.a.x, b.a.y, b.a.z, b.b.x, b.b.y, b.b.z});
    for (const ScaffoldPillar& p : scaffold.pillars) {
        pillars.push_back({p.at.x, p.at.y, p.bottom, p.top, p.foot});
    }
    for (const Beam& c : scaffold.connectors) {
        connectors.push_back({c.a.x, c.a.y, c.a.z, c.ra, c.b.x, c.b.y, c.b.z, c.rb});
    }
    const OverhangSurvey& survey = plan.survey;
    return {{"survey",
             {{"hanging_length_mm", survey.hanging_length},
              {"own_bridges", survey.own_bridges},
              {"left_out", survey.blocked},
              {"topples_at_mm", survey.topples_at ? Json(*survey.topples_at) : Json()}}},
            {"points", std::move(points)},
            {"unheld", scaffold.unheld},
            {"bars", std::move(bars)},
            {"pillars", std::move(pillars)},
            {"connectors", std::move(connectors)}};
}

std::optional<SupportPlan> read_plan(const fs::path& folder, const std::string& hash) {
    std::error_code error;
    if (folder.empty()) return std::nullopt;
    const auto size = fs::file_size(file_of(folder, hash), error);
    if (error || size > largest_file) return std::nullopt;
    try {
        std::ifstream file(file_of(folder, hash), std::ios::binary);
        const std::string text(std::istreambuf_iterator<char>(file), {});
        const Json json = Json::parse(shallow_json(text));
        if (json.at("plan") != "lamella supports" || json.at("version") != version ||
            json.at("hash") != hash || json.at("contents_hash") != contents_hash(json.at("contents"))) {
            return std::nullopt;
        }
        return plan_from(json.at("contents"));
    } catch (const std::exception&) {
        return std::nullopt;  // a plan can always be computed again
    }
}

bool keep_plan(const fs::path& folder, const std::string& hash, const SupportPlan& plan) {
    if (folder.empty()) return false;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return false;
    const Json contents = plan_json(plan);
    const Json json{{"plan", "lamella supports"},
                    {"version", version},
                    {"hash", hash},
                    {"contents_hash", contents_hash(contents)},
                    {"contents", contents}};
    try {
        write_complete_file(file_of(folder, hash), [&](std::ostream& out) { out << json.dump() << '\n'; });
    } catch (const FaultError&) {
        return false;
    }
    return true;
}

}  // namespace lamella
