#include "timeseries/series/step_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace timeseries {
namespace {

// What a step is read from once more, by a reader of its own: whoever asks has no other.
struct Reopened {
    std::vector<std::filesystem::path> files;
    StepOrigin origin;

    Field read() const {
        const auto reader = openReader(files);
        const auto variables = reader->variables();
        const auto found = std::ranges::find(variables, origin.variable, &Variable::name);
        if (found == variables.end() || origin.step >= found->time->points.size())
            throw FileError(fmt::format("{}: expected step {} of '{}', which it had before",
                                        files.front().string(), origin.step, origin.variable));
        return reader->read(static_cast<std::size_t>(found - variables.begin()), origin.step);
    }
};

}  // namespace

StepMaker::StepMaker(std::unique_ptr<Reader> reader, std::size_t variable, RangeSet kept,
                     StepStores stores)
    : reader_(std::move(reader)),
      variable_(variable),
      kept_(std::move(kept)),
      stores_(std::move(stores)) {}

std::optional<StepOrigin> originOf(Reader& reader, std::size_t variable, std::size_t step) {
    StepOrigin origin{reader.sources(variable, step), reader.variables()[variable].name, step};
    if (origin.files.empty()) return std::nullopt;
    return origin;
}

std::shared_ptr<const SortedStep> StepMaker::find(const StepOrigin& origin) {
    for (const auto& store : stores_.read) {
        auto file = store->find(origin);
        if (!file || file->type() != variable().type) continue;
        const Reopened source{{reader_->files().begin(), reader_->files().end()}, origin};
        const auto again = [store, source](const std::string& why) {
            store->discard(store->pathOf(source.origin), why);
            return SortedStep::build(source.read());
        };
        // None, should it have changed before it was read, or while it was.
        const auto field = [store, source, about = file->about()]() -> std::optional<Field> {
            const auto isStill = [&] {
                const auto stamp = store->stampOf(source.origin);
                return stamp && stamp->text == about;
            };
            try {
                if (!isStill()) return std::nullopt;
                Field read = source.read();
                return isStill() ? std::optional(std::move(read)) : std::nullopt;
            } catch (const FileError&) {
                return std::nullopt;
            }
        };
        try {
            return std::make_shared<const SortedStep>(SortedStep::stored(
                std::move(file), variable().grid, variable().categories, {again, field}));
        } catch (const StepFileError&) {  // of another grid: its file has changed
        }
    }
    return nullptr;
}

std::shared_ptr<const SortedStep> StepMaker::make(std::size_t step) {
    const bool canBe = (!stores_.read.empty() || stores_.write) && kept_ == RangeSet::everything();
    const auto origin = canBe ? originOf(*reader_, variable_, step) : std::nullopt;
    if (origin)
        if (auto found = find(*origin)) return found;
    std::optional<OriginStamp> stamp;
    if (origin && stores_.write) stamp = stores_.write->stampOf(*origin);
    auto sorted = std::make_shared<const SortedStep>(
        SortedStep::build(reader_->read(variable_, step), kept_));
    // Where a step has places of its own, the file would not have them.
    if (stamp && sorted->size() >= std::max<std::uint64_t>(stores_.worthWriting, 1) &&
        sorted->sharedGrid() == variable().grid)
        unwritten_.push_back({*origin, *stamp, sorted});
    return sorted;
}

StepMaker::Kept StepMaker::keep(std::size_t step) {
    const auto sorted = make(step);
    if (sorted->file()) return Kept::Before;
    if (!hasUnwritten()) return Kept::Not;
    const Unwritten next = unwritten_.front();
    unwritten_.pop_front();
    return stores_.write->write(next.origin, next.stamp, *sorted, reader_->openedAt) ? Kept::Written
                                                                                     : Kept::Not;
}

bool StepMaker::hasUnwritten() {
    std::erase_if(unwritten_, [](const Unwritten& each) { return each.step.expired(); });
    return !unwritten_.empty();
}

void StepMaker::writeOne(const std::function<bool(double)>& goOn) {
    if (!hasUnwritten() || !goOn(0)) return;
    const Unwritten next = unwritten_.front();
    const auto step = next.step.lock();
    if (!step) return;
    bool stopped = false;
    const auto whileMeant = [&](double share) { return !(stopped = !goOn(share)); };
    try {
        stores_.write->write(next.origin, next.stamp, *step, reader_->openedAt, whileMeant);
    } catch (const StepFileError& error) {
        stores_.write->giveUp(error.what());
        unwritten_.clear();
        stores_.write = nullptr;
        return;
    }
    if (!stopped) unwritten_.pop_front();
}

}  // namespace timeseries
