// Lists of numbers, each behind its length.
#include "recipe/structure/stopped_search.h"

#include <fmt/format.h>

#include <array>
#include <concepts>
#include <fstream>
#include <system_error>
#include <type_traits>
#include <utility>

#include "engine/base/complete_file.h"
#include "engine/base/error.h"

namespace lamella {

namespace {

using SearchMagic = std::array<char, 16>;
template <typename State>
constexpr SearchMagic magic_of{"lamella search3"};
template <>
constexpr SearchMagic magic_of<AppearanceState>{"lamella picture"};

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
    void operator()(const std::vector<std::vector<T>>& lists) const {
        (*this)(static_cast<std::uint64_t>(lists.size()));
        for (const std::vector<T>& list : lists) (*this)(list);
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
        const std::uint64_t count = take_count(sizeof(T));
        if (fails) return;
        list.resize(static_cast<std::size_t>(count));
        take(list.data(), count * sizeof(T));
    }
    template <typename T>
    void operator()(std::vector<std::vector<T>>& lists) {
        const std::uint64_t count = take_count(sizeof(std::uint64_t));
        for (std::uint64_t i = 0; i < count && !fails; ++i) (*this)(lists.emplace_back());
    }
    template <typename T>
    requires std::is_arithmetic_v<T>
    void operator()(T& number) { take(&number, sizeof number); }
    /// Other bytes than 0 and 1 are no bool.
    void operator()(bool& flag) {
        std::uint8_t byte = 0;
        (*this)(byte);
        flag = byte == 1;
        fails = fails || byte > 1;
    }

  private:
    /// Returns the length of a list whose entries take so many bytes at least.
    std::uint64_t take_count(std::uint64_t entry) {
        std::uint64_t count = 0;
        (*this)(count);
        fails = fails || count > left / entry;
        return fails ? 0 : count;
    }
    void take(void* to, std::uint64_t bytes) {
        if (fails || bytes > left || !in.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes))) {
            fails = true;
            return;
        }
        left -= bytes;
    }
};

template <typename Visited, typename T>
concept MaybeConst = std::same_as<std::remove_const_t<Visited>, T>;

/// Each visits every number of a state, in the order of the file.
template <MaybeConst<MmaState> State, typename Visit>
void visit_numbers(State& state, Visit& visit) {
    visit(state.steps);
    visit(state.former);
    visit(state.before);
    visit(state.asymptotes.low);
    visit(state.asymptotes.upp);
}

template <MaybeConst<TopologyState> State, typename Visit>
void visit_numbers(State& state, Visit& visit) {
    visit(state.design);
    visit_numbers(state.mma, visit);
    visit(state.iteration);
    visit(state.phase);
    visit(state.phase_began);
    visit(state.first_compliance);
    visit(state.volume);
    visit(state.finished);
    visit(state.displacements);
}

template <MaybeConst<LevelState> State, typename Visit>
void visit_numbers(State& state, Visit& visit) {
    visit(state.design);
    visit(state.found.compliance);
    visit(state.found.appearance);
    visit(state.found.volume);
    visit(state.found.greyness);
    visit(state.found.solver_iterations);
    visit(state.found.compliance_gradient);
    visit(state.found.appearance_gradient);
    visit_numbers(state.mma, visit);
    visit(state.matches.sweeps);
    visit(state.matches.matches);
    visit(state.matches.use);
    visit(state.displacements);
    visit(state.steps);
    visit(state.first_appearance);
}

template <MaybeConst<AppearanceState> State, typename Visit>
void visit_numbers(State& state, Visit& visit) {
    visit(state.level);
    visit(state.has_stiffest);
    visit_numbers(state.stiffest, visit);
    visit(state.least_compliance);
    visit(state.stage);
    visit(state.stage_steps);
    visit_numbers(state.pictured, visit);
    visit(state.finished);
}

}  // namespace

template <typename State>
void write_search(const std::filesystem::path& file, const StoppedSearch<State>& search) {
    write_complete_file(file, [&](std::ostream& out) {
        out.write(magic_of<State>.data(), magic_of<State>.size());
        const Writer writer{out};
        visit_numbers(search.state, writer);
        writer(search.history);
    });
}

template <typename State>
std::optional<StoppedSearch<State>> read_search(const std::filesystem::path& file) {
    std::error_code error;
    SearchMagic begins{};
    const std::uint64_t size = std::filesystem::file_size(file, error);
    if (error || size < begins.size()) return std::nullopt;
    std::ifstream in(file, std::ios::binary);
    if (!in.read(begins.data(), begins.size()) || begins != magic_of<State>) return std::nullopt;
    StoppedSearch<State> search;
    Reader reader{in, size - begins.size()};
    visit_numbers(search.state, reader);
    reader(search.history);
    if (reader.fails || reader.left > 0) return std::nullopt;
    return search;
}

template <typename State>
bool keep_search(const std::filesystem::path& file, const State& state, StructureReport& report) {
    if (file.empty()) return false;
    std::error_code ignored;
    std::filesystem::create_directories(file.parent_path(), ignored);
    try {
        write_search<State>(file, {state, report.history});
    } catch (const FaultError& error) {  // the report is what there is, then
        report.notes.push_back(fmt::format("the search cannot be resumed: {}", error.what()));
        return false;
    }
    return true;
}

template <typename State>
State kept_search(const std::filesystem::path& file, StructureReport& report) {
    std::optional<StoppedSearch<State>> stopped = read_search<State>(file);
    if (!stopped || (stopped->state.finished && stopped->history.empty()))
        throw InputError(
            fmt::format("--resume: {} keeps no search of this recipe that was stopped; accepted: the recipe "
                        "and --plans of then, or no --resume",
                        file.empty() ? "no folder" : file.parent_path().string()));
    report.history = std::move(stopped->history);
    return std::move(stopped->state);
}

template void write_search(const std::filesystem::path&, const StoppedSearch<TopologyState>&);
template void write_search(const std::filesystem::path&, const StoppedSearch<AppearanceState>&);
template std::optional<StoppedSearch<TopologyState>> read_search(const std::filesystem::path&);
template std::optional<StoppedSearch<AppearanceState>> read_search(const std::filesystem::path&);
template bool keep_search(const std::filesystem::path&, const TopologyState&, StructureReport&);
template bool keep_search(const std::filesystem::path&, const AppearanceState&, StructureReport&);
template TopologyState kept_search(const std::filesystem::path&, StructureReport&);
template AppearanceState kept_search(const std::filesystem::path&, StructureReport&);

}  // namespace lamella
