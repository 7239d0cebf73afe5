// The picture in its place in the window: drawn when it changes, refined when it rests, shown again
// otherwise.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "app/choices/preferences.h"
#include "app/desktop/rest.h"
#include "app/drawing/canvas.h"
#include "app/drawing/governor.h"
#include "app/drawing/picture_error.h"
#include "app/panels/panel_context.h"
#include "render/frame/kept_picture.h"
#include "render/frame/present.h"

namespace app::desktop {

// Needs a current GL context, from construction to destruction.
class PictureView {
 public:
    // How large each eye's picture is in a place: with two eyes, each has half of it.
    static glm::ivec2 eyeSize(const panels::Rect& place, Stereo mode);

    // What drawing was found to cost, by this or, so that its first frames already fit, by another.
    DrawingCosts costs() const { return governor_.costs(); }
    void beginFrom(const DrawingCosts& learnt) { governor_.beginFrom(learnt); }

    // Draws what of the picture is to be drawn now, if anything is; whether show() has something
    // else to show by then. `shown`: null while there is nothing. `playing`: it will change again
    // at once. `held`: a mouse button is, with which a hand may go on to change it.
    bool draw(const Shown* shown, bool playing, bool held, const panels::Choices& choices);
    // Puts the picture into the window's framebuffer, with ground around it.
    void show(glm::ivec2 window, const panels::Rect& place) const;
    // When it is to be drawn again although nothing changes; none when it is whole.
    std::optional<std::chrono::nanoseconds> untilNextDraw() const;

    // What an eye sees at a place of the picture, y down; none there, and where the picture is
    // still of other data.
    std::optional<Reading> read(glm::vec2 at, const Explorer& shown) const;
    // What read() answers where that keeps nobody waiting: none too where it would take kSoon or
    // more.
    std::optional<Reading> readSoon(glm::vec2 at, const Explorer& shown);
    static constexpr std::chrono::milliseconds kSoon{50};

    // How long the frame took that the last draw() belongs to, where the GPU did not tell.
    void took(std::chrono::nanoseconds frame);

    // Whether somebody looks at the parts of its error, which are told later than that.
    void wantParts(bool wanted) { parts_ = wanted ? Parts::All : Parts::None; }

    Canvas& canvas() { return canvas_; }
    const panels::Performance& performance() const { return performance_; }
    // Of the picture of what is shown, where it is drawn whole and its error is known.
    std::optional<double> errorOf(const Shown& shown) const {
        return isCurrent(shown) && measured_ ? performance_.error() : std::nullopt;
    }
    const render::Outline& outline() const { return outline_; }
    std::optional<render::View> eye() const {  // where there is one
        return eyes_.size() == 1 ? std::optional(eyes_.front()) : std::nullopt;
    }

 private:
    using Clock = std::chrono::steady_clock;
    // What the kept picture shows.
    struct Content {
        Explorer explorer;
        std::shared_ptr<const timeseries::SortedStep> sorted;
    };

    bool isCurrent(const Shown& shown) const;
    bool isDone() const { return report_.whole && report_.told; }  // nothing more comes at rest
    bool waitsForError() const;
    void tellError();     // of a picture that is whole and rests
    void predictError();  // of one that was just drawn, from what was told of its selection
    void redraw(const Shown& shown, bool resting, const panels::Choices& choices);
    // How many splats a picture that comes to rest begins with.
    std::uint64_t firstSlice(std::chrono::nanoseconds slice) const;
    // What a picture may hold that moves.
    CanvasLimits moving(const Explorer& explorer, const panels::Choices& choices) const;

    Canvas canvas_{render::SplatterChoice::ByDevice, render::LightAs::Srgb8};
    render::Present present_;
    Governor governor_;  // of cells also of slices
    // While points are refined: a slice of them has no axes to draw, and its splats are others.
    std::optional<render::FramePace> slices_;
    std::optional<render::KeptPicture> kept_;
    std::optional<Content> content_;
    CanvasReport report_;
    panels::Performance performance_;
    PictureError error_;
    std::optional<DepthErrors> errors_;  // told last, and of which selection:
    Explorer errorsOf_;
    std::optional<Parts> measured_;  // of the picture that is kept: what was asked for
    Parts parts_ = Parts::None;      // what is to be
    // Panels were drawn before the parts came, and what opens for them has its size a frame later.
    int partsCame_ = 0;  // so many frames are to come
    render::Outline outline_{glm::dmat3(0.5)};
    std::vector<render::View> eyes_;
    glm::ivec2 grid_{1};  // how many eyes' pictures stand beside and above each other
    Rest rest_;
    bool isThere_ = false;  // anything to show
    bool playing_ = false;  // at the last draw(): a refinement stands still
    double readNs_ = 10;    // of a read, a splat drawn, as the last one took
    bool timed_ = true;     // what was drawn last has its time
};

}  // namespace app::desktop
