#include "app/frames.h"

#include <fmt/format.h>

#include "app/picture_files.h"

namespace app {

namespace fs = std::filesystem;

Frames::Frames(fs::path output, const Explorer& e, std::vector<std::size_t> steps)
    : output_(std::move(output)),
      steps_(std::move(steps)),
      swept_(e.sweep.has_value()),
      stereo_(e.stereo.mode) {
    count_ = swept_ ? static_cast<std::size_t>(timeseries::ValueSweep(*e.sweep).ticksPerCycle())
                    : steps_.size();
    digits_ = std::to_string(swept_ ? count_ - 1 : steps_.back()).size();
}

FrameAt Frames::operator[](std::size_t i) const {
    const std::size_t step = swept_ ? steps_[i * steps_.size() / count_] : steps_[i];
    fs::path file = output_;
    if (count_ > 1)
        file.replace_filename(fmt::format("{}_{:0{}}{}", file.stem().string(), swept_ ? i : step,
                                          digits_, file.extension().string()));
    return {step, swept_ ? static_cast<std::int64_t>(i) : 0, file};
}

std::string Frames::names() const {
    const fs::path first = filesOf(front().file, stereo_).front();
    const fs::path last = filesOf(back().file, stereo_).back();
    if (first == last) return first.string();
    return fmt::format("{} {} {}", first.string(), count_ == 1 ? "and" : "to",
                       last.filename().string());
}

}  // namespace app
