#include "app/panels/quality_page.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "app/choices/edits.h"
#include "app/choices/idle_choices.h"
#include "app/choices/view_edits.h"
#include "render/annotate/ticks.h"

namespace app::panels {
namespace {

// Sizes from 1/4 to 4 of the kernel, from 1 to 16 pixels of points, evenly by factors.
void sizeSlider(PanelContext& context, Form& form) {
    const render::Footprint now = context.exploration.explorer().footprint;
    const bool point = now.kernel == render::Kernel::Point;
    const double least = point ? 1 : 0.25;
    const Rect row = form.row("Size");
    const float s = context.theme.scale;
    double fraction = std::log2(now.size / least) / 4;
    // A key: a pixel, or a fifth of an octave.
    const double step = point ? std::log2((now.size + 1) / now.size) / 4 : 0.05;
    if (slider(context.theme, "##size", {row.min, {row.max.x - 56 * s, row.max.y}}, fraction, step))
        edit(context, "splat size", [&](Explorer& e) {
            const double size = least * std::exp2(4 * fraction);
            e.footprint.size = point ? std::round(size) : roundedTo(size, 0.01 * size);
        });
    text(context.theme, {row.max.x, row.centre().y},
         point ? fmt::format("{:.0f} px", now.size) : fmt::format("× {:.2f}", now.size), kDim, 1,
         context.theme.small);
}

void pointRows(PanelContext& context, Form& form) {
    constexpr std::array kKernels = {"Squares", "Soft splats"};
    const Explorer& e = context.exploration.explorer();
    if (const auto kernel = segmented(context.theme, "kernel", form.row("Points as"), kKernels,
                                      static_cast<std::size_t>(e.footprint.kernel)))
        edit(context, {}, [&](Explorer& next) {
            next.footprint = {.kernel = static_cast<render::Kernel>(*kernel),
                              .size = *kernel == 0 ? 3.0 : 1.0};
        });
    sizeSlider(context, form);
}

// An angle from `least` on, over so many degrees.
void angleSlider(PanelContext& context, Form& form, const char* label, double least, double span,
                 double LampChoice::*angle) {
    const Rect row = form.row(label);
    const float s = context.theme.scale;
    const double now = (*context.exploration.explorer().lamp).*angle;
    double fraction = std::clamp((now - least) / span, 0.0, 1.0);
    if (slider(context.theme, label, {row.min, {row.max.x - 56 * s, row.max.y}}, fraction,
               5 / span))
        edit(context, label,
             [&](Explorer& e) { (*e.lamp).*angle = std::round(least + fraction * span); });
    text(context.theme, {row.max.x, row.centre().y},
         render::withMinusSigns(fmt::format("{:.0f}°", now)), kDim, 1, context.theme.small);
}

// Where light comes from.
void lampRows(PanelContext& context, Form& form) {
    constexpr std::array kFrom = {"Eye", "Fixed"};
    const Explorer& e = context.exploration.explorer();
    if (const auto from = segmented(context.theme, "lamp", form.row("Light from"), kFrom,
                                    e.lamp ? std::size_t{1} : 0))
        edit(context, {}, [&](Explorer& next) {
            next.lamp = *from == 0 ? std::nullopt : std::optional(lampBeside(next.view));
        });
    if (!context.exploration.explorer().lamp) return;
    angleSlider(context, form, "Around", -180, 360, &LampChoice::azimuthDegrees);
    angleSlider(context, form, "Above", -90, 180, &LampChoice::elevationDegrees);
    form.note("The lamp stands still: what is turned shows it another side.");
}

void lightRows(PanelContext& context, Form& form) {
    constexpr std::array kLights = {"Off", "Soft", "Full"};
    const Explorer& e = context.exploration.explorer();
    if (const std::string_view why = whyUnlit(e); !why.empty())
        return form.note(fmt::format("Cells are not lit: {}.", why));
    if (const auto light = segmented(context.theme, "light", form.row("Light"), kLights,
                                     static_cast<std::size_t>(e.light)))
        edit(context, {}, [&](Explorer& next) { next.light = static_cast<render::Light>(*light); });
    if (e.light != render::Light::Off) lampRows(context, form);
}

void budget(PanelContext& context, Form& form) {
    constexpr std::array kRates = {"60", "30", "20", "10"};
    constexpr std::array<std::int64_t, 4> kPerSecond = {60, 30, 20, 10};
    std::size_t now = 0;
    for (std::size_t i = 0; i < kPerSecond.size(); ++i)
        if (std::llround(1e9 / static_cast<double>(context.choices.frameBudget.count())) ==
            kPerSecond[i])
            now = i;
    if (const auto rate = segmented(context.theme, "rate", form.row("Frames / s"), kRates, now))
        context.choices.frameBudget = std::chrono::nanoseconds(1'000'000'000 / kPerSecond[*rate]);
}

void errorAllowed(PanelContext& context, Form& form) {
    constexpr std::array kNames = {"1 %", "3 %", "10 %", "30 %"};
    constexpr std::array kErrors = {0.01, 0.03, 0.1, 0.3};
    std::size_t now = 0;
    for (std::size_t i = 0; i < kErrors.size(); ++i)
        if (context.choices.movingError >= kErrors[i]) now = i;
    if (const auto error = segmented(context.theme, "error", form.row("Error up to"), kNames, now))
        context.choices.movingError = kErrors[*error];
}

// One way to draw a picture that moves.
void rungRows(PanelContext& context, Form& form) {
    constexpr std::array kModels = {"Points", "Cells"}, kPixels = {"All", "A quarter"};
    constexpr std::array kStrides = {"All", "1/2", "1/4", "1/8", "1/16"};
    Rung& rung = context.choices.movingRung;
    if (const auto model = segmented(context.theme, "moving by", form.row("Moving, draw"), kModels,
                                     static_cast<std::size_t>(rung.model)))
        rung = {static_cast<Model>(*model), 1, rung.across};
    if (rung.model == Model::Points)
        if (const auto stride =
                segmented(context.theme, "moving stride", form.row("Of them"), kStrides,
                          static_cast<std::size_t>(std::countr_zero(rung.stride))))
            rung.stride = 1u << *stride;
    if (const auto pixels = segmented(context.theme, "moving pixels", form.row("Pixels"), kPixels,
                                      rung.across == 1 ? 0 : 1))
        rung.across = *pixels == 0 ? 1 : kCoarse;
}

// What a moving picture leaves out.
void movingRows(PanelContext& context, Form& form) {
    constexpr std::array kKept = {"Pace", "Error", "Fixed", "All"};
    if (const auto kept = segmented(context.theme, "moving", form.row("Moving, keep"), kKept,
                                    static_cast<std::size_t>(context.choices.moving)))
        context.choices.moving = static_cast<Moving>(*kept);
    if (context.choices.moving == Moving::Pace) budget(context, form);
    if (context.choices.moving == Moving::Error) errorAllowed(context, form);
    if (context.choices.moving == Moving::Fixed) rungRows(context, form);
    constexpr std::array kNotes = {
        "While the picture moves, it is as true as fits this pace; where that would show little "
        "of the field, slower, down to 20 a second; at rest, whole.",
        "While the picture moves, as little is drawn as keeps this error, once it is known, "
        "whatever a frame takes.",
        "While the picture moves, it is drawn this way, whatever a frame takes.",
        "A picture that moves is drawn whole, whatever a frame takes."};
    form.note(kNotes[static_cast<std::size_t>(context.choices.moving)]);
}

// The most that is drawn in a headset, where the display's pace always holds.
void mostRows(PanelContext& context, Form& form) {
    constexpr std::array kMost = {"All", "By error", "Fixed"};
    constexpr std::array kMoving = {Moving::Pace, Moving::Error, Moving::Fixed};
    std::size_t now = 0;
    for (std::size_t i = 0; i < kMoving.size(); ++i)
        if (context.choices.moving == kMoving[i]) now = i;
    if (const auto most = segmented(context.theme, "most", form.row("At most"), kMost, now))
        context.choices.moving = kMoving[now = *most];
    if (kMoving[now] == Moving::Error) errorAllowed(context, form);
    if (kMoving[now] == Moving::Fixed) rungRows(context, form);
    constexpr std::array kNotes = {
        "As much is drawn as keeps the display's pace.",
        "As little as keeps this error, once it is known; less where the display's pace asks "
        "for it.",
        "No more than this; less where the display's pace asks for it."};
    form.note(kNotes[now]);
}

void interfaceScale(PanelContext& context, Form& form) {
    constexpr std::array kNames = {"Monitor's", "1", "1.25", "1.5", "2"};
    constexpr std::array<double, 5> kScales = {0, 1, 1.25, 1.5, 2};
    std::size_t now = 0;
    for (std::size_t i = 1; i < kScales.size(); ++i)
        if (context.choices.scale == kScales[i]) now = i;
    if (const auto chosen =
            segmented(context.theme, "interface", form.row("Interface"), kNames, now))
        context.choices.scale = *chosen == 0 ? std::nullopt : std::optional(kScales[*chosen]);
}

}  // namespace

void drawQualityPage(PanelContext& context, const Rect& at) {
    if (!context.exploration.shown()) return;
    constexpr std::array kOrders = {"None", "By depth"};
    Form form(context.theme, "##quality", at);
    const Explorer& e = context.exploration.explorer();
    constexpr std::array kModels = {"Points", "Cells"};
    if (const auto model = segmented(context.theme, "model", form.row("Draw"), kModels,
                                     static_cast<std::size_t>(e.model)))
        edit(context, {}, [&](Explorer& next) { next.model = static_cast<Model>(*model); });
    constexpr std::array kPers = {"Length", "Crossing"};
    const std::string_view whyNot = context.exploration.shown()->sorted->whyNoCells();
    const bool byCells = modelOf(e) == Model::Cells && whyNot.empty();
    if (modelOf(e) == Model::Cells && !whyNot.empty())
        form.note(fmt::format("Points are drawn: {}.", whyNot));
    if (byCells) {
        form.note("Between points, too: a thin range is a closed shell.");
        lightRows(context, form);
        if (const auto per = segmented(context.theme, "per", form.row("Opacity per"), kPers,
                                       static_cast<std::size_t>(e.opacityPer)))
            edit(context, {},
                 [&](Explorer& next) { next.opacityPer = static_cast<render::OpacityPer>(*per); });
        form.note("Per crossing, a thin range is as opaque as a wide one.");
    }
    if (!byCells || mixesModels(e)) pointRows(context, form);
    if (const auto order = segmented(context.theme, "order", form.row("Order"), kOrders,
                                     static_cast<std::size_t>(e.order)))
        edit(context, {}, [&](Explorer& next) { next.order = static_cast<render::Order>(*order); });
    form.note(e.order == render::Order::None ? "Colours mix along the line of sight. By depth, "
                                               "what is in front hides what is behind."
                                             : "What is in front hides what is behind.");
    form.space(6);
    if (context.inHeadset) return mostRows(context, form);  // and a panel as large as it is
    movingRows(context, form);
    interfaceScale(context, form);
}

}  // namespace app::panels
