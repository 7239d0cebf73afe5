#include "app/panels/file_panel.h"

#include <fmt/format.h>

#include <cstdlib>

#include "app/choices/choice_text.h"
#include "app/choices/paths.h"
#include "app/exploration/export_job.h"
#include "render/image/picture_file.h"
#include "timeseries/readers/text/words.h"

namespace app::panels {
namespace {

namespace fs = std::filesystem;

// "~" is the user's home, as in a shell; the rest is relative to the folder listed.
fs::path meant(const std::string& typed, const fs::path& folder) {
    const char* home = std::getenv("HOME");
    if (home != nullptr && (typed == "~" || typed.starts_with("~/")))
        return fs::path(home) / (typed.size() > 2 ? typed.substr(2) : "");
    return folder / typed;
}

const char* titleOf(FilePanel::For what) {
    switch (what) {
        case FilePanel::For::Open:
            return "Open a file, a folder or a session";
        case FilePanel::For::Save:
            return "Save the session as";
        case FilePanel::For::Export:
            return "Export the animation as (.png or .exr, numbered)";
    }
    return "";
}

const char* actionOf(FilePanel::For what) {
    switch (what) {
        case FilePanel::For::Open:
            return "Open";
        case FilePanel::For::Save:
            return "Save";
        case FilePanel::For::Export:
            return "Export";
    }
    return "";
}

void end() {
    focus().leaveFront();
    endRegion();
}

// Why nothing can be written there, a line; "" where something can. What is no file, as a pipe, is
// not tried.
std::string whyNot(const fs::path& file) {
    std::error_code unknown;
    if (fs::exists(file, unknown) && !fs::is_regular_file(file, unknown)) return "";
    try {
        const render::PartialFile tried(file);
        return "";
    } catch (const std::exception& error) {
        const std::string why = error.what(), prefix = file.string() + ": ";
        return "It " + (why.starts_with(prefix) ? why.substr(prefix.size()) : why);
    }
}

}  // namespace

std::string exportedText(const FrameFiles& frames, const timeseries::CursorSettings& play) {
    if (frames.size() == 1) return frames.names();
    const bool otherwise = play.direction == timeseries::Direction::Backward ||
                           play.ending == timeseries::Ending::PingPong;
    return fmt::format("{} pictures{}: {}", withCommas(frames.size()),
                       otherwise ? ", forwards once" : "", frames.names());
}

void FilePanel::ask(For what, const fs::path& path, glm::ivec2 size) {
    for_ = what;
    typed_ = path.string();
    size_ = fmt::format("{}x{}", size.x, size.y);
    answeredTo_.clear();
    focus_ = true;
    const fs::path folder = fs::absolute(path.has_parent_path() ? path.parent_path() : ".");
    list(folder.lexically_normal());
    if (what == For::Open) typed_.clear();
}

fs::path FilePanel::chosen() const {
    fs::path path = meant(typed_, folder_).lexically_normal();
    if (for_ == For::Save && timeseries::lower(path.extension().string()) != ".json")
        path += ".json";
    return path;
}

void FilePanel::list(const fs::path& folder) {
    folder_ = folder;
    contents_ = {};
    listing_.emplace(folder, all_, wake_);
}

void FilePanel::take(PanelContext& context, const fs::path& path) {
    const bool again = asked_ && answeredTo_ == wish(path);
    answer_ = flaw(context, path);
    asked_ = answer_.empty() && *for_ != For::Open;
    if (asked_ && !again) answer_ = warning(context, path);
    answeredTo_ = wish(path);
    if (!answer_.empty()) return;
    switch (*for_) {
        case For::Open:
            context.requests.open = {path};
            break;
        case For::Save:
            context.requests.save = path;
            break;
        case For::Export:
            context.requests.exportTo = {path, parseSize(size_)};
    }
    close();
}

std::string FilePanel::flaw(const PanelContext& context, const fs::path& path) const {
    std::error_code gone;
    if (*for_ == For::Open) return isThere(path) ? "" : "There is no such file";
    if (!fs::is_directory(path.parent_path(), gone))
        return fmt::format("There is no folder {}", path.parent_path().string());
    if (*for_ == For::Save) return whyNot(path);
    if (std::string flaw = flawOfPictures(path); !flaw.empty()) return flaw;
    return context.exploration.shown() ? whyNot(pictures(context, path).front().file) : "";
}

// Of their name and their size.
std::string FilePanel::flawOfPictures(const fs::path& path) const {
    if (!render::isPng(path) && !render::isExr(path)) return "Its name ends in .png or in .exr";
    try {
        parseSize(size_);
    } catch (const ChoiceError& error) {
        return error.what();
    }
    return "";
}

FrameFiles FilePanel::pictures(const PanelContext& context, const fs::path& path) {
    const auto shown = context.exploration.shown();
    const Explorer animation = animationOf(context.exploration.explorer(), shown->dataset);
    return {path, animation, stepsOf(shown->dataset, *animation.steps), shown->dataset.stepCount()};
}

std::string FilePanel::warning(const PanelContext& context, const fs::path& path) const {
    constexpr std::size_t kMany = 10'000;
    std::size_t files = 1, existing = 0;
    if (*for_ == For::Export && context.exploration.shown()) {
        const FrameFiles frames = pictures(context, path);
        files = frames.fileCount();
        if (files > kMany)
            return fmt::format("{} pictures: again to make them all", withCommas(frames.size()));
        existing = frames.existing();
    } else {
        std::error_code gone;
        existing = fs::exists(path, gone) ? 1 : 0;
    }
    if (existing == 0) return "";
    if (files == 1) return "It exists: again to replace it";
    return fmt::format("{} of its {} files {}: again to replace {}", existing, files,
                       existing == 1 ? "exists" : "exist", existing == 1 ? "it" : "them");
}

void FilePanel::draw(PanelContext& context) {
    if (!for_) return;
    if (listing_) {
        if (auto contents = listing_->poll()) {
            contents_ = std::move(*contents);
            listing_.reset();
        }
    }
    const Theme& theme = context.theme;
    const float s = theme.scale;
    const Rect& window = context.layout.window;
    const glm::vec2 half = 0.5f * glm::min(glm::vec2(640, 520) * s, window.size() - 24 * s);
    const Rect at{glm::floor(window.centre() - half), glm::floor(window.centre() + half)};
    ImGui::SetNextWindowFocus();
    beginRegion("##files", window, faded(kGround, 0.6f), Depth::Front);
    focus().enterFront();
    ImDrawList& drawn = *ImGui::GetWindowDrawList();
    drawn.AddRectFilled(im(at.min), im(at.max), kPanel, 8 * s);
    drawn.AddRect(im(at.min), im(at.max), kLine, 8 * s);
    const float left = at.min.x + 20 * s, right = at.max.x - 20 * s;
    text(theme, {left, at.min.y + 26 * s}, titleOf(*for_), kText, 0, theme.strong);
    text(theme, {left, at.min.y + 50 * s}, fitting(*theme.small, folder_.string(), right - left),
         kDim, 0, theme.small);

    ImGui::SetCursorScreenPos({left, at.min.y + 64 * s});
    ImGui::SetNextItemWidth(right - left);
    const Rect field{{left, at.min.y + 64 * s},
                     {right, at.min.y + 64 * s + ImGui::GetFrameHeight()}};
    if (takesText("##path", field) || focus_) ImGui::SetKeyboardFocusHere();
    focus_ = false;
    const bool entered = inputText("##path", "type a path, or choose below", typed_);
    if (ImGui::IsItemActivated()) focus().touch(ImGui::GetID("##path"));
    const float foot = at.max.y - (*for_ == For::Export ? 104 : 60) * s;  // the list's
    drawList(context, {{left, at.min.y + 104 * s}, {right, foot}});
    const bool sized =
        *for_ == For::Export && drawSize(context, {{left, foot + 8 * s}, {right, foot + 38 * s}});

    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) close();
    if (!for_) return end();

    const float y = at.max.y - 46 * s;
    if (*for_ == For::Open) {
        constexpr std::array kFilter = {"Readable", "All files"};
        if (const auto filter =
                segmented(theme, "filter", {{left, y}, {left + 180 * s, y + 30 * s}}, kFilter,
                          all_ ? 1 : 0)) {
            all_ = *filter == 1;
            list(folder_);
        }
    }
    drawAnswer(context,
               {{*for_ == For::Open ? left + 192 * s : left, y}, {right - 220 * s, y + 30 * s}});
    if (textButton(theme, "Cancel", {{right - 208 * s, y}, {right - 108 * s, y + 30 * s}},
                   "Cancel"))
        close();
    const bool pressed =
        for_ &&
        textButton(theme, "Do", {{right - 100 * s, y}, {right, y + 30 * s}}, actionOf(*for_), true);
    if (for_ && (entered || sized || pressed)) {
        const fs::path path = meant(typed_, folder_).lexically_normal();
        if (entered && isFolder(path)) {
            list(path);
            typed_.clear();
            focus_ = true;
        } else if (!typed_.empty() || *for_ == For::Open) {
            take(context, chosen());
            focus_ = for_.has_value();
        }
    }
    end();
}

bool FilePanel::drawSize(const PanelContext& context, const Rect& at) {
    const Theme& theme = context.theme;
    const float s = theme.scale, y = at.centre().y;
    const Rect field{{at.min.x + 52 * s, at.min.y}, {at.min.x + 172 * s, at.max.y}};
    text(theme, {at.min.x, y}, "Size", kDim);
    text(theme, {field.max.x + 10 * s, y}, "pixels", kDim, 0, theme.small);
    ImGui::SetCursorScreenPos(im(field.min));
    ImGui::SetNextItemWidth(field.size().x);
    if (takesText("##size", field)) ImGui::SetKeyboardFocusHere();
    const bool entered = inputText("##size", "1200x900", size_);
    if (ImGui::IsItemActivated()) focus().touch(ImGui::GetID("##size"));
    return entered;
}

void FilePanel::drawAnswer(const PanelContext& context, const Rect& at) const {
    const bool answered = !answer_.empty() && answeredTo_ == wish(chosen());
    const auto tell = [&](const std::string& line, ImU32 color) {
        text(context.theme, {at.min.x, at.centre().y},
             fitting(*context.theme.text, line, at.size().x), color);
    };
    if (answered) return tell(answer_, kError);
    if (*for_ != For::Export || !context.exploration.shown()) return;
    // While it is typed.
    if (const std::string flaw = flawOfPictures(chosen()); !flaw.empty()) return tell(flaw, kDim);
    const FrameFiles frames = pictures(context, chosen().filename());
    if (const std::string leftOut = frames.leftOut(); !leftOut.empty())
        return tell(leftOut, kError);
    tell(exportedText(frames, context.exploration.explorer().play.time), kDim);
}

void FilePanel::drawList(PanelContext& context, const Rect& at) {
    const float s = context.theme.scale;
    ImGui::GetWindowDrawList()->AddRectFilled(im(at.min), im(at.max), kGround, 5 * s);
    ImGui::SetCursorScreenPos(im(at.min));
    ImGui::BeginChild("##list", im(at.size()));
    const glm::vec2 origin = vec(ImGui::GetCursorScreenPos());
    float y = origin.y + 4 * s;
    const auto line = [&](const char* id, Icon icon, std::string_view name, bool lit) {
        const Rect r{{at.min.x + 4 * s, y}, {at.max.x - 10 * s, y + 28 * s}};
        y += 28 * s;
        const Pressing p = button(id, r, lit || r.min.y < origin.y + 28 * s);  // the first
        if (r.max.y < at.min.y || r.min.y > at.max.y) return p;
        ImDrawList& list = *ImGui::GetWindowDrawList();
        if (p.hovered || p.focused || lit)
            list.AddRectFilled(im(r.min), im(r.max), lit ? faded(kAccent, 0.16f) : kField, 4 * s);
        drawIcon(list, icon, {r.min.x + 16 * s, r.centre().y}, s,
                 icon == Icon::Folder ? kAccent : kDim);
        text(context.theme, {r.min.x + 34 * s, r.centre().y},
             fitting(*context.theme.text, name, r.size().x - 44 * s));
        return p;
    };
    std::optional<fs::path> enter, open;
    if (folder_.has_parent_path() && folder_ != folder_.root_path() &&
        line("..", Icon::Folder, "..", false).clicked)
        enter = folder_.parent_path();
    for (const FolderEntry& entry : contents_.entries) {
        const std::string name = entry.path.filename().string();
        const Pressing p = line(name.c_str(), entry.isFolder ? Icon::Folder : Icon::File, name,
                                !entry.isFolder && name == typed_);
        if (p.clicked && entry.isFolder) enter = entry.path;
        if (p.clicked && !entry.isFolder) typed_ = name;
        if ((p.doubled || (p.clicked && p.focused)) && !entry.isFolder) open = entry.path;
    }
    if (!contents_.why.empty())
        text(context.theme, {at.min.x + 14 * s, y + 14 * s}, contents_.why, kError);
    if (listing_) text(context.theme, {at.min.x + 14 * s, y + 14 * s}, "…", kDim);
    ImGui::SetCursorScreenPos({origin.x, y});
    ImGui::Dummy({1, 4 * s});
    ImGui::EndChild();
    if (enter) {
        if (*for_ == For::Open) typed_.clear();
        list(*enter);
    }
    if (open) take(context, *for_ == For::Open ? *open : chosen());
}

}  // namespace app::panels
