#include "app/desktop/file_actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/choices/command_line.h"
#include "app/choices/session.h"
#include "app/choices/user_files.h"
#include "app/json_text.h"
#include "app/picture/depth_error.h"
#include "app/picture/picture.h"
#include "timeseries/sentence.h"

namespace app::desktop {
namespace {

namespace fs = std::filesystem;

// The first of NAME_0000.png, NAME_0001.png, ... that does not exist.
fs::path numbered(const std::string& name) {
    for (int i = 0;; ++i) {
        fs::path file = fmt::format("{}_{:04}.png", name, i);
        if (!fs::exists(file)) return file;
    }
}

// Beside the program as it is built, or where the user stands.
fs::path findDemo() {
    std::error_code gone;
    const fs::path name = "datasets/pool_fire_T.nc";
    for (fs::path folder = fs::read_symlink("/proc/self/exe", gone).parent_path();
         folder != folder.parent_path(); folder = folder.parent_path())
        if (fs::exists(folder / name, gone)) return folder / name;
    return fs::exists(name, gone) ? fs::absolute(name) : fs::path();
}

// What `work` cannot do becomes a message.
template <typename Work>
void telling(Exploration& exploration, const Work& work) {
    try {
        work();
    } catch (const std::exception& error) {
        exploration.tell(timeseries::sentenceOf(error), true);
    }
}

}  // namespace

FileActions::FileActions(Exploration& exploration, Canvas& canvas,
                         std::optional<ExportJob>& exporting,
                         std::function<void(const std::string&)> copy)
    : exploration_(exploration),
      canvas_(canvas),
      copy_(std::move(copy)),
      autosave_(stateFolder()),
      left_(leftSessions(stateFolder())),
      demo_(findDemo()),
      export_(exporting) {
    ReadPreferences read = readPreferences(preferencesFile());
    if (!read.problem.empty()) exploration_.tell(read.problem, true);
    preferences_ = kept_ = std::move(read.preferences);
}

void FileActions::serve(const panels::Requests& requests, panels::Interface& interface,
                        const std::optional<double>& error) {
    if (!requests.open.empty()) open(requests.open);
    if (requests.save) save(*requests.save, error);
    if (requests.exportTo) exportTo(requests.exportTo->output, requests.exportTo->size);
    if (requests.cancelExport) cancelExport();
    if (requests.discardLeft) discardLeft();
    for (const panels::Command command : requests.commands) {
        if (interface.obey(exploration_, command)) continue;
        if (command == panels::Command::Screenshot) screenshot(error);
        if (command == panels::Command::CopyCommandLine) copyCommandLine();
    }
}

void FileActions::open(const std::vector<fs::path>& named) {
    if (!holdsSession(named.front())) return openData(named);
    telling(exploration_, [&] { openSession(named.front()); });
}

// A session whose data are gone waits for them: a file of the same name is taken for them.
void FileActions::openData(const std::vector<fs::path>& named) {
    std::optional<Explorer> waiting = std::exchange(waiting_, std::nullopt);
    if (!waiting || waiting->files.front().filename() != named.front().filename())
        return exploration_.open(named);
    waiting->files = named;
    exploration_.open(std::move(*waiting));
}

void FileActions::openSession(const fs::path& file) {
    Explorer session = readSession(file);
    waiting_.reset();
    if (const auto missing = missingFile(session)) {
        exploration_.tell(fmt::format("{}: its data are not there any more: open {}, where it is "
                                      "now, or drop it here",
                                      file.filename().string(), missing->filename().string()),
                          true);
        waiting_ = std::move(session);
        return;
    }
    exploration_.open(std::move(session));
    const auto left = std::ranges::find(left_, file, &LeftSession::file);
    goingOn_ = left == left_.end() ? std::nullopt : std::optional(*left);
}

// A session that was left behind is not offered twice, once it is shown. One whose data are gone
// stays: they may come back.
void FileActions::settleLeft() {
    if (!goingOn_ || exploration_.opening()) return;
    const LeftSession left = *std::exchange(goingOn_, std::nullopt);
    const Explorer &now = exploration_.explorer(), &wished = left.explorer;
    if (sameData(now, wished) && now.layers == wished.layers) forgetLeft(left.file);
}

void FileActions::forgetLeft(const fs::path& file) {
    std::error_code gone;
    fs::remove(file, gone);
    std::erase_if(left_, [&](const LeftSession& left) { return left.file == file; });
}

void FileActions::discardLeft() {
    if (!left_.empty()) forgetLeft(fs::path(left_.front().file));
}

void FileActions::save(const fs::path& file, const std::optional<double>& error) {
    telling(exploration_, [&] {
        Explorer e = exploration_.explorer();
        if (const auto shown = exploration_.shown();
            shown && e.steps == StepChoice{shown->step, shown->step})
            e.stepTime = timeKept(*shown->dataset.variable.time, shown->step);
        nlohmann::json session = toJson(e, file.parent_path());
        if (error && std::isfinite(*error)) session[kSessionErrorKey] = *error;
        if (error && std::isinf(*error))
            session[kSessionErrorKey] = "inf";  // JSON has no such number
        writeWhole(file, jsonText(session, 2) + "\n");
        exploration_.tell("Saved " + file.string());
        exploration_.expectSameFiles();
    });
}

void FileActions::screenshot(const std::optional<double>& error) {
    const auto shown = exploration_.shown();
    if (!shown) return;
    telling(exploration_, [&] {
        const fs::path file =
            numbered(fs::path(shown->dataset.name).stem().string() + "_screenshot");
        canvas_.save(*shown, file, error);
        const bool isAsAsked = shown->explorer.map == exploration_.explorer().map;
        exploration_.tell((isAsAsked ? "Screenshot: " : "Screenshot, lying flat: ") +
                          fs::absolute(file).string());
        exploration_.expectSameFiles();
    });
}

void FileActions::copyCommandLine() {
    const auto shown = exploration_.shown();
    if (!shown) return;
    const Explorer& asked = exploration_.explorer();
    const Explorer picture = onlyThis(asked, shown->step, asked.play.tick);
    const std::vector<std::string> arguments =
        renderArguments(picture, "picture.png", fs::current_path());
    copy_(callOfProgram() + " " + shellText(arguments));
    telling(exploration_, [&] {
        exploration_.expectSameFiles();
        exploration_.tell("Copied: the command line that makes this picture");
    });
}

void FileActions::exportTo(const fs::path& output, glm::ivec2 size) {
    const auto shown = exploration_.shown();
    if (!shown) return;
    if (export_) return exploration_.tell("One export at a time: cancel the one that runs", true);
    telling(exploration_, [&] {
        exploration_.expectSameFiles();
        Explorer animation = animationOf(exploration_.explorer(), shown->dataset);
        animation.size = size;
        export_.emplace(animation, FrameFiles(fs::absolute(output), animation,
                                              stepsOf(shown->dataset, *animation.steps),
                                              shown->dataset.stepCount()));
    });
}

void FileActions::cancelExport() {
    if (export_) export_->cancel();
}

std::optional<std::string> FileActions::exporting() const {
    if (!export_) return std::nullopt;
    const std::size_t count = export_->frames().size();
    return fmt::format("Exporting picture {} of {}", std::min(export_->done() + 1, count), count);
}

void FileActions::attendExport() {
    if (!export_) return;
    export_->poll();
    if (export_->state() == ExportJob::State::Running) return;
    exploration_.tell(export_->outcome(), export_->state() == ExportJob::State::Failed);
    export_.reset();
}

void FileActions::prefer(const panels::Choices& choices) {
    preferences_.uiScale = choices.scale;
    preferences_.frameMilliseconds =
        std::chrono::duration<double, std::milli>(choices.frameBudget).count();
    preferences_.moving = choices.moving;
    preferences_.movingError = choices.movingError;
    preferences_.movingRung = choices.movingRung;
}

void FileActions::goOn() {
    attendExport();
    settleLeft();
    if (!exploration_.shown()) return;
    if (const auto problem = autosave_.save(exploration_.explorer(), Autosave::Clock::now()))
        exploration_.tell(*problem, true);
    keepPreferences();
}

void FileActions::keepPreferences() {
    const std::vector<fs::path>& files = exploration_.explorer().files;
    if (files != remembered_ && !files.empty()) {
        remember(preferences_, files);
        remembered_ = files;
    }
    if (preferences_ == kept_) return;
    kept_ = preferences_;
    telling(exploration_, [&] { writePreferences(preferences_, preferencesFile()); });
}

std::optional<std::chrono::nanoseconds> FileActions::untilKept() const {
    if (!exploration_.shown()) return std::nullopt;
    return autosave_.untilSaved(exploration_.explorer(), Autosave::Clock::now());
}

void FileActions::keep(const DrawingCosts& costs) {
    if (!exploration_.shown()) return;
    if (costs.points) preferences_.costs.points = costs.points;
    if (costs.cells) preferences_.costs.cells = costs.cells;
    keepPreferences();
}

void FileActions::finish() { autosave_.discard(); }

void FileActions::rescue() {
    // Nobody is there to be told of a failure; no pause is kept.
    autosave_.save(exploration_.explorer(), Autosave::Clock::time_point::max());
}

panels::StartOffers FileActions::offers() const {
    return {.recent = preferences_.recent,
            .demo = demo_,
            .autosave = left_.empty() || goingOn_ ? fs::path() : left_.front().file};
}

}  // namespace app::desktop
