// What the user asks of the world outside the window: files, the clipboard, a child that exports;
// and what is kept for the next time.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/choices/autosave.h"
#include "app/choices/preferences.h"
#include "app/drawing/canvas.h"
#include "app/exploration/exploration.h"
#include "app/exploration/export_job.h"
#include "app/panels/interface.h"

namespace app::desktop {

// Failures become messages of the exploration. The references must outlive it.
class FileActions {
 public:
    // `exporting`: goes on from one front end to the next. `copy`: puts a text on the clipboard.
    FileActions(Exploration& exploration, Canvas& canvas, std::optional<ExportJob>& exporting,
                std::function<void(const std::string&)> copy);

    // Does what panels ask for, but for readings of the picture, which whoever draws it has.
    // `error`: of the picture shown (depth_error.h), where it is known, for what is saved.
    void serve(const panels::Requests& requests, panels::Interface& interface,
               const std::optional<double>& error = {});

    // A member of a series, a folder, several files; a session, or a picture that carries one.
    void open(const std::vector<std::filesystem::path>& named);
    void save(const std::filesystem::path& file, const std::optional<double>& error = {});
    // Works the error out where it is not known.
    void screenshot(const std::optional<double>& error);
    void copyCommandLine();
    void exportTo(const std::filesystem::path& output, glm::ivec2 size);
    void cancelExport();

    // What a window's user prefers from now on: a headset's panel is as large as it is.
    void prefer(const panels::Choices& choices);
    // Once a frame: what is to be kept is kept, and a child's progress is told.
    void goOn();
    // Until goOn() has something to keep, though nothing happens any more.
    std::optional<std::chrono::nanoseconds> untilKept() const;
    // What a window has learnt, when it closes: until then it changes with every frame.
    void keep(const DrawingCosts& costs);
    // At a clean end.
    void finish();
    // At an end that nobody asked for: what is to be offered at the next start is kept as it is
    // now.
    void rescue();

    // The session offered that broke off.
    void discardLeft();

    panels::StartOffers offers() const;
    const Preferences& preferences() const { return preferences_; }
    // How far an export is, in words, while one runs.
    std::optional<std::string> exporting() const;

 private:
    void attendExport();
    void keepPreferences();
    void openData(const std::vector<std::filesystem::path>& named);
    void openSession(const std::filesystem::path& file);
    void settleLeft();
    void forgetLeft(const std::filesystem::path& file);

    Exploration& exploration_;
    Canvas& canvas_;
    std::function<void(const std::string&)> copy_;
    Preferences preferences_, kept_;
    Autosave autosave_;
    std::vector<LeftSession> left_;
    std::optional<LeftSession> goingOn_;  // on its way to be shown
    std::optional<Explorer> waiting_;     // whose data were not there
    std::filesystem::path demo_;
    std::optional<ExportJob>& export_;
    std::vector<std::filesystem::path> remembered_;  // the files that were last remembered
};

}  // namespace app::desktop
