// A JSON file a plan, read with every size and number checked.
#include "app/support_plan.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace lamella {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int version = 1;
constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30;
constexpr SupportReason last_reason = SupportReason::stability;

fs::path file_of(const fs::path& folder, const std::string& hash) { return folder / (hash + ".json"); }

/// Exactly `count` finite numbers.
std::vector<double> row(const Json& json, std::size_t count) {
    auto numbers = json.get<std::vector<double>>();
    if (numbers.size() != count) throw std::runtime_error("a row of the wrong length");
    for (const double number : numbers) {
        if (!std::isfinite(number)) throw std::runtime_error("a number that is not finite");
    }
    return numbers;
}

SupportPoint point_from(const Json& json) {
    const auto n = row(json, 4);
    if (n[3] < 0 || n[3] > static_cast<double>(last_reason)) throw std::runtime_error("an unknown reason");
    return {{n[0], n[1], n[2]}, static_cast<SupportReason>(n[3])};
}

SupportPlan plan_from(const Json& json) {
    SupportPlan plan;
    const Json& survey = json.at("survey");
    plan.survey.hanging_length = survey.at("hanging_length_mm").get<double>();
    plan.survey.own_bridges = survey.at("own_bridges").get<std::size_t>();
    plan.survey.blocked = survey.at("left_out").get<std::size_t>();
    if (!survey.at("topples_at_mm").is_null()) {
        plan.survey.topples_at = survey.at("topples_at_mm").get<double>();
    }
    Scaffold& scaffold = plan.scaffold;
    for (const Json& point : json.at("points")) scaffold.points.push_back(point_from(point));
    plan.survey.points = scaffold.points;
    for (const Json& number : json.at("unheld")) {
        scaffold.unheld.push_back(number.get<std::size_t>());
        if (scaffold.unheld.back() >= scaffold.points.size()) throw std::runtime_error("no such point");
    }
    for (const Json& bar : json.at("bars")) {
        const auto n = row(bar, 6);
        scaffold.bars.push_back({{n[0], n[1], n[2]}, {n[3], n[4], n[5]}});
    }
    for (const Json& pillar : json.at("pillars")) {
        const auto n = row(pillar, 5);
        scaffold.pillars.push_back({{n[0], n[1]}, n[2], n[3], n[4]});
    }
    for (const Json& connector : json.at("connectors")) {
        const auto n = row(connector, 8);
        scaffold.connectors.push_back({{n[0], n[1], n[2]}, n[3], {n[4], n[5], n[6]}, n[7]});
    }
    return plan;
}

}  // namespace

fs::path default_plan_folder() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return value ? fs::path(value) : fs::path();
    };
    if (const fs::path cache = variable("XDG_CACHE_HOME"); !cache.empty()) return cache / "lamella/plans";
    if (const fs::path home = variable("HOME"); !home.empty()) return home / ".cache/lamella/plans";
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
        const Json json = Json::parse(file);
        if (json.at("plan") != "lamella supports" || json.at("version") != version ||
            json.at("hash") != hash) {
            return std::nullopt;
        }
        return plan_from(json);
    } catch (const std::exception&) {
        return std::nullopt;  // a plan can always be made again
    }
}

bool keep_plan(const fs::path& folder, const std::string& hash, const SupportPlan& plan) {
    if (folder.empty()) return false;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return false;
    Json json{{"plan", "lamella supports"}, {"version", version}, {"hash", hash}};
    json.update(plan_json(plan));
    // Shards may keep the same plan at the same time: each writes a file of its own first.
    const fs::path unfinished = folder / fmt::format("{}.{}.partial", hash, getpid());
    {
        std::ofstream file(unfinished, std::ios::binary);
        file << json.dump() << '\n';
        file.close();
        if (file.fail()) {
            fs::remove(unfinished, error);
            return false;
        }
    }
    fs::rename(unfinished, file_of(folder, hash), error);
    if (error) fs::remove(unfinished, error);
    return !error;
}

}  // namespace lamella
