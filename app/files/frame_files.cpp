#include "app/files/frame_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "app/files/picture_files.h"

namespace app {

namespace fs = std::filesystem;

FrameFiles::FrameFiles(fs::path output, const Explorer& e, std::vector<std::size_t> steps,
                       std::size_t stepCount)
    : output_(std::move(output)),
      steps_(std::move(steps)),
      swept_(sweepOf(e) != nullptr && !e.oneTick),
      standing_(e.oneTick ? e.play.tick : 0),
      stereo_(e.stereo.mode) {
    count_ = swept_ ? static_cast<std::size_t>(timeseries::ValueSweep(*sweepOf(e)).ticksPerCycle())
                    : steps_.size();
    digits_ =
        std::to_string(swept_ ? count_ - 1 : std::max(steps_.back() + 1, stepCount) - 1).size();
}

FrameAt FrameFiles::operator[](std::size_t i) const {
    const std::size_t step = swept_ ? steps_[i * steps_.size() / count_] : steps_[i];
    fs::path file = output_;
    if (count_ > 1)
        file.replace_filename(fmt::format("{}_{:0{}}{}", file.stem().string(), swept_ ? i : step,
                                          digits_, file.extension().string()));
    return {step, swept_ ? static_cast<std::int64_t>(i) : standing_, file};
}

std::string FrameFiles::names() const {
    const fs::path first = filesOf(front().file, stereo_).front();
    const fs::path last = filesOf(back().file, stereo_).back();
    if (first == last) return first.string();
    return fmt::format("{} {} {}", first.string(), count_ == 1 ? "and" : "to",
                       last.filename().string());
}

std::string FrameFiles::leftOut() const {
    if (count_ >= steps_.size()) return "";
    const std::size_t left = steps_.size() - count_;
    return fmt::format("{} of {} steps {} no picture: the sweep has {} tick{}", left, steps_.size(),
                       left == 1 ? "has" : "have", count_, count_ == 1 ? "" : "s");
}

std::size_t FrameFiles::fileCount() const { return count_ * filesOf(front().file, stereo_).size(); }

std::optional<std::size_t> FrameFiles::numbered(std::size_t number) const {
    if (swept_) return number < count_ ? std::optional(number) : std::nullopt;
    const auto step = std::ranges::lower_bound(steps_, number);
    if (step == steps_.end() || *step != number) return std::nullopt;
    return static_cast<std::size_t>(step - steps_.begin());
}

bool FrameFiles::has(const fs::path& name) const {
    std::optional<std::size_t> i = 0;
    if (count_ > 1) {
        const std::string text = name.string();
        const std::size_t stem = output_.stem().string().size() + 1;
        const char* const digits = text.data() + std::min(stem, text.size());
        std::size_t number = 0;
        const auto read = std::from_chars(digits, text.data() + text.size(), number);
        i = read.ec == std::errc{} ? numbered(number) : std::nullopt;
    }
    return i && std::ranges::any_of(filesOf((*this)[*i].file, stereo_),
                                    [&](const fs::path& file) { return file.filename() == name; });
}

// By the names that are there: of those that may come there are too many to look for each.
std::size_t FrameFiles::existing() const {
    const fs::path folder = output_.has_parent_path() ? output_.parent_path() : ".";
    std::size_t found = 0;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
        if (has(at->path().filename())) ++found;
    return found;
}

}  // namespace app
