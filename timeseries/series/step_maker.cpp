#include "timeseries/series/step_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <utility>

namespace timeseries {
namespace {

// What a step on disk was made of, read by a reader of its own: whoever asks has no other.
struct Reopened {
    // Of the whole series: thousands, which its steps share.
    std::shared_ptr<const std::vector<std::filesystem::path>> files;
    std::string variable;
    std::size_t step;  // of the series
    std::shared_ptr<StepStore> store;
    StepOrigin origin;
    std::string about;  // the origin's stamp then

    bool isStill() const {
        const auto stamp = store->stampOf(origin);
        return stamp && stamp->text == about;
    }
    struct Open {
        std::shared_ptr<Reader> reader;
        std::size_t variable;
    };
    // Of these, nothing, should it have changed before it was read, or while it was.
    std::optional<Open> open() const {
        if (!isStill()) return std::nullopt;
        const std::shared_ptr<Reader> reader = openReader(*files);
        const auto variables = reader->variables();
        const auto found = std::ranges::find(variables, variable, &Variable::name);
        if (found == variables.end() || step >= found->time->points.size()) return std::nullopt;
        const auto v = static_cast<std::size_t>(found - variables.begin());
        // Files before its own may have gained steps.
        if (originOf(*reader, v, step) != origin) return std::nullopt;
        return Open{reader, v};
    }
    std::optional<Field> read() const try {
        const auto opened = open();
        if (!opened) return std::nullopt;
        Field field = opened->reader->read(opened->variable, step);
        return isStill() ? std::optional(std::move(field)) : std::nullopt;
    } catch (const FileError&) {
        return std::nullopt;
    }
    static PlanesOf planes(const std::shared_ptr<const Reopened>& of) try {
        const auto opened = of->open();
        if (!opened || !opened->reader->readsPlanes(opened->variable, of->step)) return {};
        return [of, opened = *opened](std::size_t first, std::size_t count, Field& planes) {
            try {
                opened.reader->readSlab(opened.variable, of->step, {2, first, count}, planes);
            } catch (const FileError&) {
                return false;
            }
            return of->isStill();
        };
    } catch (const FileError&) {
        return {};
    }
};

// One that is neither missing nor NaN.
bool hasValue(const Field& field) {
    return std::visit(
        [&](const auto& values) {
            for (std::size_t i = 0; i < values.size(); ++i)
                if (values[i] == values[i] && (field.missing.empty() || !field.missing[i]))
                    return true;
            return false;
        },
        field.values);
}

}  // namespace

StepMaker::StepMaker(std::unique_ptr<Reader> reader, std::size_t variable, RangeSet kept,
                     StepStores stores, Holds holds, RangeSet asked)
    : reader_(std::move(reader)),
      files_(std::make_shared<const std::vector<std::filesystem::path>>(reader_->files().begin(),
                                                                        reader_->files().end())),
      opened_(reader_->files()),
      variable_(variable),
      kept_(std::move(kept)),
      asked_(std::move(asked)),
      holds_(holds),
      stores_(std::move(stores)) {}

SortedStep StepMaker::sorted(Field field) const {
    if (kept_ != RangeSet::everything()) return SortedStep::build(std::move(field), kept_);
    if (holds_ == Holds::Field) return SortedStep::buildWithField(std::move(field), asked_);
    return SortedStep::build(std::move(field), asked_);
}

Field StepMaker::read(std::size_t step) {
    std::vector<std::filesystem::path> files = reader_->sources(variable_, step).files;
    // A reader that does not know which they are may have few.
    if (files.empty() && reader_->files().size() <= OpenedFiles::kFew)
        files.assign(reader_->files().begin(), reader_->files().end());
    opened_.expectSame(files);
    Field field = reader_->read(variable_, step);
    opened_.expectSame(files);
    return field;
}

void StepMaker::tellSortedAnew(const StepOrigin& origin) {
    if (!std::exchange(toldChanged_, true))  // of thousands the first
        stores_.read.front()->tellChanged(origin.files.front());
}

std::optional<StepOrigin> originOf(Reader& reader, std::size_t variable, std::size_t step) {
    const Variable& of = reader.variables()[variable];
    // One of two of a name could be taken for the other.
    if (std::ranges::count(reader.variables(), of.name, &Variable::name) > 1) return std::nullopt;
    StepSources sources = reader.sources(variable, step);
    if (sources.files.empty()) return std::nullopt;
    return StepOrigin{std::move(sources.files), sources.step, of.name, of.storedAs};
}

void expectThere(const StepOrigin& origin) {
    for (const std::filesystem::path& file : origin.files) {
        std::error_code failed;
        if (!std::filesystem::exists(file, failed))
            throw FileError(
                fmt::format("{}: it has been removed since it was opened", file.string()));
    }
}

std::shared_ptr<const SortedStep> StepMaker::find(const StepOrigin& origin, std::size_t step,
                                                  bool* changed) {
    for (const auto& store : stores_.read) {
        auto file = store->find(origin, changed);
        if (!file || file->type() != variable().type) continue;
        const auto source = std::make_shared<const Reopened>(
            Reopened{files_, variable().name, step, store, origin, file->about()});
        const auto field = [source] { return source->read(); };
        const auto planes = [source] { return Reopened::planes(source); };
        const auto again = [source](const std::string& why) {
            source->store->discard(source->store->pathOf(source->origin), why);
            if (auto read = source->read()) return SortedStep::build(std::move(*read));
            throw FileError(
                fmt::format("{}: {}", source->origin.files.front().string(), kHasChanged));
        };
        try {
            return std::make_shared<const SortedStep>(SortedStep::stored(
                std::move(file), variable().grid, variable().categories, {again, field, planes}));
        } catch (const StepFileError&) {  // of another grid: its file has changed
        }
    }
    return nullptr;
}

std::shared_ptr<const SortedStep> StepMaker::make(std::size_t step) {
    if (kept_ == RangeSet::everything())
        if (auto file = reader_->sorted(variable_, step))
            return std::make_shared<const SortedStep>(
                SortedStep::ofFile(std::move(file), variable().grid, variable().categories));
    const bool canBe = (!stores_.read.empty() || stores_.write) && kept_ == RangeSet::everything();
    const auto origin = canBe ? originOf(*reader_, variable_, step) : std::nullopt;
    bool changed = false;
    if (origin)
        if (auto found = find(*origin, step, &changed)) return found;
    std::optional<OriginStamp> stamp;
    if (origin && stores_.write) stamp = stores_.write->stampOf(*origin);
    auto made = std::make_shared<const SortedStep>(sorted(read(step)));
    if (changed) tellSortedAnew(*origin);
    // Where a step has places of its own, the file would not have them.
    if (stamp && made->kept() == RangeSet::everything() &&
        made->size() >= std::max<std::uint64_t>(stores_.worthWriting, 1) &&
        made->sharedGrid() == variable().grid) {
        std::erase_if(unwritten_, [&](const Unwritten& each) { return each.step == step; });
        unwritten_.push_back({step, *origin, *stamp, made, made->pointBytes()});
    }
    return made;
}

StepMaker::Kept StepMaker::keep(std::size_t step, const GoOn& goOn) {
    const auto origin = originOf(*reader_, variable_, step);
    if (origin) expectThere(*origin);
    bool changed = false;
    if (reader_->sorted(variable_, step) || (origin && find(*origin, step, &changed)))
        return Kept::Before;
    std::optional<OriginStamp> stamp;
    if (origin && stores_.write) stamp = stores_.write->stampOf(*origin);
    const Field field = read(step);
    if (origin && goOn && !goOn(0)) return keptAs(StepStore::Wrote::Nothing, *origin);
    if (!hasValue(field)) return Kept::Empty;
    if (field.grid != variable().grid) return Kept::Moves;
    if (!origin) {
        try {
            return keptWithoutOrigin(*reader_, variable_);
        } catch (const FileError&) {  // of another step
            return Kept::Unknown;
        }
    }
    if (!stamp || kept_ != RangeSet::everything() || field.type() != variable().type) {
        expectThere(*origin);
        return Kept::Unknown;
    }
    if (changed) tellSortedAnew(*origin);
    const auto into = [&](WholeFile& file) { return writeField(field, stamp->text, file, goOn); };
    return keptAs(stores_.write->write(*origin, *stamp, reader_->openedAt, into), *origin);
}

StepMaker::Kept StepMaker::keptWithoutOrigin(Reader& reader, std::size_t variable) {
    return reader.stepGrids(variable).are == StepGrids::Are::One ? Kept::Unknown : Kept::Moves;
}

StepMaker::Kept StepMaker::keptAs(StepStore::Wrote wrote, const StepOrigin& origin) const {
    switch (wrote) {
        case StepStore::Wrote::All:
            return Kept::Written;
        case StepStore::Wrote::NoRoom:
            return Kept::NoRoom;
        case StepStore::Wrote::Nothing:
            break;
    }
    expectThere(origin);
    return Kept::Changed;
}

StepMaker::Kept StepMaker::keepNoMore(std::size_t step) {
    const auto origin = originOf(*reader_, variable_, step);
    if (!origin) return keptWithoutOrigin(*reader_, variable_);
    expectThere(*origin);
    return find(*origin, step) ? Kept::Before : Kept::NoRoom;
}

StepStore::Wrote StepMaker::write(const Unwritten& one, const SortedStep* sorted,
                                  const GoOn& goOn) {
    if (sorted)
        return stores_.write->write(one.origin, one.stamp, *sorted, reader_->openedAt, goOn);
    // What it would push out may be as much in use.
    const auto file = stores_.write->pathOf(one.origin);
    if (!stores_.write->room().isFree(file, one.bytes)) return StepStore::Wrote::Nothing;
    try {
        return keep(one.step, goOn) == Kept::NoRoom ? StepStore::Wrote::NoRoom
                                                    : StepStore::Wrote::All;
    } catch (const FileError&) {  // told where somebody looks at it
        return StepStore::Wrote::Nothing;
    }
}

bool StepMaker::canWrite(Again again) const {
    return again == Again::Read ? !unwritten_.empty() : std::ranges::any_of(unwritten_, isInUse);
}

bool StepMaker::writeOne(Again again, const GoOn& goOn) {
    std::shared_ptr<const SortedStep> held;  // nobody lets go of it meanwhile
    auto next = std::ranges::find_if(
        unwritten_, [&](const Unwritten& one) { return (held = one.sorted.lock()) != nullptr; });
    if (next == unwritten_.end() && again == Again::Read) next = unwritten_.begin();
    if (next == unwritten_.end() || !goOn(0)) return true;
    bool stopped = false;
    const auto whileMeant = [&](double share) { return !(stopped = !goOn(share)); };
    const auto giveUp = [&](const std::string& why) {
        stores_.write->giveUp(why);
        unwritten_.clear();
        stores_.write = nullptr;
        return false;
    };
    try {
        if (write(*next, held.get(), whileMeant) == StepStore::Wrote::NoRoom)
            return giveUp(
                fmt::format("{} may take less than one of these steps does (--cache-size)",
                            stores_.write->folder().string()));
    } catch (const StepFileError& error) {
        return giveUp(error.what());
    } catch (const std::exception&) {  // as for want of memory: it stays unwritten
    }
    if (!stopped) unwritten_.erase(next);
    return true;
}

}  // namespace timeseries
