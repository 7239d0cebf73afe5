// The bar along the bottom: play, step, where in time, what is loaded, in and out points, ending
// and speed.
#pragma once

#include "app/panels/panel_context.h"
#include "app/panels/widgets.h"

namespace app::panels {

class TimeBar {
 public:
    void draw(PanelContext& context, const Rect& at);

 private:
    enum class Grip { None, Cursor, In, Out };
    void rail(PanelContext& context, const Rect& at);
    Grip grip_ = Grip::None;
    TextField speed_;
};

// Sets the in or the out point to a step; the other gives way where they would cross.
enum class Point { In, Out };
void setPoint(timeseries::CursorSettings& time, Point point, std::size_t step);
// Real times get a speed, unless they have one, at which the series takes as long as evenly.
void setPace(timeseries::CursorSettings& time, timeseries::Pace pace,
             const timeseries::TimeAxis& axis);
// What its speed counts: "steps/s", "hours/s".
std::string speedUnit(const timeseries::CursorSettings& time, const timeseries::TimeAxis& axis);

}  // namespace app::panels
