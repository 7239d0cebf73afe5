#include "timeseries/readers/sequence_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

#include "timeseries/in_turn.h"
#include "timeseries/readers/kept_readers.h"
#include "timeseries/readers/series_files.h"
#include "timeseries/readers/series_times.h"
#include "timeseries/together.h"

namespace timeseries {
namespace {

using Path = std::filesystem::path;

// Files to look at.
constexpr std::size_t kWorthAThread = 32;

// The place in `all` of the variable that one of another file is: of its name, or nameless as it.
std::optional<std::size_t> placeOf(const Variable& variable, std::span<const Variable> all) {
    const auto same = [&](const Variable& other) {
        return variable.nameless ? other.nameless : other.name == variable.name;
    };
    const auto found = std::ranges::find_if(all, same);
    if (found == all.end()) return std::nullopt;
    return static_cast<std::size_t>(found - all.begin());
}

class SequenceReader final : public Reader {
 public:
    SequenceReader(std::span<const Path> paths, OpenOne openOne, const GlanceAt& glanceAt,
                   GridsOf gridsOf, OpenedOn on)
        : paths_(paths.begin(), paths.end()),
          openOne_(std::move(openOne)),
          gridsOf_(std::move(gridsOf)),
          isGlanced_(paths.size()) {
        const WrittenAt firstAt = writtenAt(paths_[0]);
        auto first = openOne_(paths_[0]);
        format_ = first->format();
        variables_.assign(first->variables().begin(), first->variables().end());
        axes_.resize(variables_.size());
        counts_.resize(variables_.size());
        for (std::size_t v = 0; v < variables_.size(); ++v) take(v, variables_[v]);
        auto glances = glancesAt(glanceAt);
        // What a file says of itself; nothing of one that was glanced at.
        const auto said = [&](std::size_t f) {
            if (glances[f]) return std::vector<Variable>();
            const auto reader = openOne_(paths_[f]);
            return std::vector(reader->variables().begin(), reader->variables().end());
        };
        const std::size_t worthAThread = on == OpenedOn::AllThreads ? kWorthAThread : paths_.size();
        inTurn(1, paths_.size(), worthAThread, said, [&](std::size_t f, const auto& variables) {
            if (glances[f])
                add(f, std::move(*glances[f]));
            else
                add(f, variables);
        });
        for (Variable& variable : variables_)
            if (variable.nameless) variable.name = commonName(paths_);
        for (std::size_t v = 0; v < variables_.size(); ++v) joinTimes(v);
        axes_.clear();
        tellUnfit();
        if (glanceAt) open_.keep(0, firstAt, std::move(first));
    }

    std::string format() const override { return format_; }
    std::span<const Path> files() const override { return paths_; }
    std::span<const Variable> variables() const override { return variables_; }
    Field read(std::size_t variable, std::size_t step) override;
    void readSlab(std::size_t variable, std::size_t step, const Slab& slab, Field& into) override {
        const Member member = memberOf(variable, step);
        member.reader.readSlab(member.variable, member.step, slab, into);
    }
    bool readsPlanes(std::size_t variable, std::size_t step) override {
        const Member member = memberOf(variable, step);
        return member.reader.readsPlanes(member.variable, member.step);
    }
    std::shared_ptr<const StepFile> sorted(std::size_t variable, std::size_t step) override {
        const Member member = memberOf(variable, step);
        return member.reader.sorted(member.variable, member.step);
    }
    StepSources sources(std::size_t variable, std::size_t step) override;
    StepGrids stepGrids(std::size_t variable) override;
    void expectToFit(std::size_t file) override {
        if (isGlanced_[file]) open(file);
    }
    std::optional<StepSpan> stepsOf(std::size_t variable, std::size_t file) const override {
        const auto& begins = times_[variable].begins;
        return StepSpan{begins[file], begins[file + 1] - begins[file]};
    }

 private:
    struct Counts {
        std::uint64_t least = std::numeric_limits<std::uint64_t>::max(), most = 0;
    };

    void take(std::size_t v, const Variable& its);
    void add(std::size_t file, std::span<const Variable> its);
    std::vector<std::optional<Glance>> glancesAt(const GlanceAt& glanceAt) const;
    void compare(std::size_t file, Glance& glance) const;
    void add(std::size_t file, Glance glance);
    void tellLeftOut(const std::string& variable);
    void tellUnfit();
    const Variable& expectSame(const Variable& expected, std::size_t file,
                               std::span<const Variable> its) const;
    void joinTimes(std::size_t v);
    Reader& open(std::size_t file);
    struct Member {
        Reader& reader;
        std::size_t variable, step;  // of the member's own
    };
    Member memberOf(std::size_t variable, std::size_t step);
    void expectThen(std::size_t v, std::size_t file, const TimeAxis& now) const;
    std::string withoutVariable(std::size_t file, const std::string& name) const {
        return fmt::format("{} and {}: expected the same variables, but the second has no '{}'",
                           paths_[0].string(), paths_[file].string(), name);
    }
    [[noreturn]] void differ(std::size_t a, std::size_t b, const std::string& what) const {
        throw FileError(fmt::format("{} and {}: {}", paths_[a].string(), paths_[b].string(), what));
    }

    const std::vector<Path> paths_;
    const OpenOne openOne_;
    const GridsOf gridsOf_;  // none: all files were opened
    std::string format_;
    std::vector<Variable> variables_;  // the first file's, with the times of all
    std::vector<Counts> counts_;       // [variable]: points of the files that were opened
    std::vector<TimesOfFiles> axes_;   // [variable], while opening
    std::vector<SeriesTimes> times_;   // [variable]
    std::vector<bool> isGlanced_;      // [file]: it was not opened with the series
    std::vector<std::string> unfit_;   // while opening, why: of each that is glanced at
    KeptReaders open_;
};

const Variable& SequenceReader::expectSame(const Variable& expected, std::size_t file,
                                           std::span<const Variable> its) const {
    const auto at = placeOf(expected, its);
    if (!at) throw FileError(withoutVariable(file, expected.name));
    const Variable* const found = &its[*at];
    const std::string place = fmt::format("variable '{}': expected the same ", expected.name);
    if (found->type != expected.type)
        differ(0, file,
               fmt::format("{}type, found {} and {}", place, typeName(expected.type),
                           typeName(found->type)));
    if (found->units != expected.units)
        differ(
            0, file,
            fmt::format("{}units, found \"{}\" and \"{}\"", place, expected.units, found->units));
    if (!gridOfStep(expected.grid, found->grid)) {
        const auto a = expected.grid->size(), b = found->grid->size();
        differ(0, file,
               a == b ? fmt::format("{}grid, but their {} x {} x {} points lie elsewhere", place,
                                    a[0], a[1], a[2])
                      : fmt::format("{}grid, found {} x {} x {} and {} x {} x {} points", place,
                                    a[0], a[1], a[2], b[0], b[1], b[2]));
    }
    return *found;
}

void SequenceReader::take(std::size_t v, const Variable& its) {
    axes_[v].push_back(its.time);
    counts_[v].least = std::min(counts_[v].least, its.grid->count());
    counts_[v].most = std::max(counts_[v].most, its.grid->count());
}

void SequenceReader::add(std::size_t file, std::span<const Variable> its) {
    for (std::size_t v = 0; v < variables_.size(); ++v)
        take(v, expectSame(variables_[v], file, its));
    for (const Variable& other : its)
        if (!placeOf(other, variables_)) tellLeftOut(other.name);
}

// Where all have as many points, the files of the middle and the last step tell whether they lie
// elsewhere, or their own steps do: to hold each file's mesh against the first takes as long as to
// read some.
StepGrids SequenceReader::stepGrids(std::size_t v) {
    if (gridsOf_) return gridsOf_(paths_, *variables_[v].grid);
    const std::size_t steps = variables_[v].time->points.size();
    const auto [least, most] = counts_[v];
    StepGrids grids{.are = StepGrids::Are::Own};
    if (least == most) {
        grids.are = StepGrids::Are::One;
        for (const std::size_t step : {steps / 2, steps - 1}) {
            const Member member = memberOf(v, step);
            const Grid& its = *member.reader.variables()[member.variable].grid;
            grids.are = std::max({grids.are, member.reader.stepGrids(member.variable).are,
                                  heldAgainst(*variables_[v].grid, its)});
        }
    }
    // Further steps of a file may have more.
    if (steps == paths_.size()) grids.least = least, grids.most = most;
    return grids;
}

// [file], of the first none; each compared. On several threads: a file system may answer several
// questions in the time of one.
std::vector<std::optional<Glance>> SequenceReader::glancesAt(const GlanceAt& glanceAt) const {
    std::vector<std::optional<Glance>> glances(paths_.size());
    if (!glanceAt) return glances;
    std::atomic<std::size_t> next = 1;
    sharing(threadsFor(paths_.size(), kWorthAThread), [&](unsigned) {
        for (std::size_t f; (f = next++) < paths_.size();) {
            glances[f] = glanceAt(paths_[f]);
            if (glances[f]) compare(f, *glances[f]);
        }
    });
    return glances;
}

// Leaves the variables that the first file does not have; one that is not there is a flaw.
void SequenceReader::compare(std::size_t file, Glance& glance) const {
    auto found = std::exchange(glance.variables, {});
    if (std::ranges::equal(found, variables_, {}, {}, &Variable::name)) return;
    const std::set<std::string_view> its(found.begin(), found.end());
    std::set<std::string_view> ours;
    for (const Variable& each : variables_) {
        ours.insert(each.name);
        if (glance.flaw.empty() && !its.contains(each.name))
            glance.flaw = withoutVariable(file, each.name);
    }
    for (const std::string& name : found)
        if (!ours.contains(name)) glance.variables.push_back(name);
}

void SequenceReader::add(std::size_t file, Glance glance) {
    isGlanced_[file] = true;
    for (TimesOfFiles& axes : axes_) axes.push_back(glance.time);
    for (const std::string& name : glance.variables) tellLeftOut(name);
    if (!glance.flaw.empty()) unfit_.push_back(std::move(glance.flaw));
}

void SequenceReader::tellLeftOut(const std::string& variable) {
    const std::string note = fmt::format("'{}' is not in the first file: it is left out", variable);
    auto& notes = variables_.front().notes;
    if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
}

void SequenceReader::tellUnfit() {
    if (unfit_.empty()) return;
    for (Variable& variable : variables_)
        variable.notes.push_back(fmt::format("the steps of {} of {} files cannot be read{}: {}",
                                             unfit_.size(), paths_.size(),
                                             unfit_.size() > 1 ? ", the first" : "", unfit_[0]));
    unfit_.clear();
}

void SequenceReader::joinTimes(std::size_t v) {
    Variable& variable = variables_[v];
    times_.push_back(seriesTimes(variable.name, axes_[v], paths_));
    variable.time = times_[v].time;
    if (const std::string& note = times_[v].note; !note.empty()) variable.notes.push_back(note);
    for (std::size_t other = 0; other < v; ++other)
        if (axes_[other] == axes_[v]) variable.time = variables_[other].time;
}

// Expects the times of a file to be those with which the series was opened.
void SequenceReader::expectThen(std::size_t v, std::size_t file, const TimeAxis& now) const {
    const auto& [time, begins, areOwn, note] = times_[v];
    const std::size_t then = begins[file + 1] - begins[file];
    if (now.points.size() != then)
        throw FileError(
            fmt::format("{}: expected {} steps as when the series was opened, "
                        "found {}",
                        paths_[file].string(), then, now.points.size()));
    const TimeAxis& series = *time;
    if (areOwn && !now.counted &&
        (now.name != series.name || now.units != series.units || now.calendar != series.calendar))
        throw FileError(fmt::format(
            "{}: expected times '{}' in \"{}\" as when the series was opened, found '{}' in \"{}\"",
            paths_[file].string(), series.name, series.units, now.name, now.units));
    for (std::size_t i = 0; areOwn && i < then; ++i)
        if (const double told = series.points[begins[file] + i].value;
            now.counted || now.points[i].value != told)
            throw FileError(
                fmt::format("{}: expected the time {} as when the series was opened, found {}",
                            paths_[file].string(), told,
                            now.counted ? "none" : fmt::format("{}", now.points[i].value)));
}

Reader& SequenceReader::open(std::size_t file) {
    const WrittenAt at = writtenAt(paths_[file]);
    if (Reader* const kept = open_.find(file, at)) return *kept;
    auto reader = openOne_(paths_[file]);
    // It may have been written anew since the series was opened.
    for (std::size_t v = 0; v < variables_.size(); ++v)
        expectThen(v, file, *expectSame(variables_[v], file, reader->variables()).time);
    return open_.keep(file, at, std::move(reader));
}

SequenceReader::Member SequenceReader::memberOf(std::size_t variable, std::size_t step) {
    const auto& begins = times_[variable].begins;
    const auto file =
        static_cast<std::size_t>(std::ranges::upper_bound(begins, step) - begins.begin() - 1);
    Reader& reader = open(file);
    return {reader, placeOf(variables_[variable], reader.variables()).value(), step - begins[file]};
}

StepSources SequenceReader::sources(std::size_t variable, std::size_t step) {
    const Member member = memberOf(variable, step);
    const auto& grid = variables_[variable].grid;
    if (gridOfStep(grid, member.reader.variables()[member.variable].grid) != grid) return {};
    return member.reader.sources(member.variable, member.step);
}

Field SequenceReader::read(std::size_t variable, std::size_t step) {
    const Member member = memberOf(variable, step);
    Field field = member.reader.read(member.variable, member.step);
    field.grid = gridOfStep(variables_[variable].grid, field.grid);
    return field;
}

}  // namespace

std::unique_ptr<Reader> openSequence(std::span<const Path> paths, OpenOne openOne,
                                     const GlanceAt& glanceAt, GridsOf gridsOf, OpenedOn on) {
    return std::make_unique<SequenceReader>(paths, std::move(openOne), glanceAt, std::move(gridsOf),
                                            on);
}

}  // namespace timeseries
