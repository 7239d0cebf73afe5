// A path asked for inside the window: to open, to save a session, to export pictures to.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "app/files/folder_listing.h"
#include "app/files/frame_files.h"
#include "app/panels/panel_context.h"
#include "app/panels/widgets.h"

namespace app::panels {

class FilePanel {
 public:
    enum class For { Open, Save, Export };

    // `wake`: see FolderListing.
    explicit FilePanel(std::function<void()> wake) : wake_(std::move(wake)) {}

    // `path`: what is typed at first. Its folder is listed. `size`: of the picture that is shown.
    void ask(For what, const std::filesystem::path& path, glm::ivec2 size = {1, 1});
    void close() { for_.reset(); }
    bool isOpen() const { return for_.has_value(); }
    bool isListing() const { return isOpen() && listing_.has_value(); }
    void draw(PanelContext& context);

 private:
    // The path typed. A session has its ending, by which it is known when it is opened.
    std::filesystem::path chosen() const;
    void list(const std::filesystem::path& folder);
    void drawList(PanelContext& context, const Rect& at);
    void take(PanelContext& context, const std::filesystem::path& path);
    // What speaks against the path, a line: nothing is there to be opened, or nothing can be
    // written there, which is tried. "" when nothing does.
    std::string flaw(const PanelContext& context, const std::filesystem::path& path) const;
    std::string flawOfPictures(const std::filesystem::path& path) const;
    // The animation's pictures. REQUIRES: something is shown.
    static FrameFiles pictures(const PanelContext& context, const std::filesystem::path& path);
    // What is asked for, in full: an answer is about it until it changes.
    std::string wish(const std::filesystem::path& path) const {
        return path.string() + '\n' + size_;
    }
    // Of an export's pictures; whether Enter was pressed there.
    bool drawSize(const PanelContext& context, const Rect& at);
    // What is to be known before it is taken: the last answer, which steps are left out, or which
    // pictures there will be.
    void drawAnswer(const PanelContext& context, const Rect& at) const;
    // What would be replaced, or that very many pictures would be made, asked as one line; "" when
    // neither.
    std::string warning(const PanelContext& context, const std::filesystem::path& path) const;

    std::function<void()> wake_;
    std::optional<For> for_;
    std::filesystem::path folder_;
    std::optional<FolderListing> listing_;
    FolderContents contents_;
    std::string typed_, size_;         // a path; "1200x900"
    std::string answeredTo_, answer_;  // what was taken last, and why it was not
    bool asked_ = false;               // the answer is warning()'s
    bool all_ = false, focus_ = false;
};

// Which pictures an export makes. One goes through its steps forwards, once, however they play.
std::string exportedText(const FrameFiles& frames, const timeseries::CursorSettings& play);

}  // namespace app::panels
