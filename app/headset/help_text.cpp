#include "app/headset/help_text.h"

namespace app::headset {

std::string helpText(const std::string& runtime, const xr::Controls& controls) {
    std::string text = "In " + runtime + "\n";
    if (controls.text.empty()) return text + "No controllers yet";
    text += controls.text + "\nBoth hands: scale and turn\n";
    if (controls.sticks)
        text +=
            "Right stick: values · left stick: time, a step with each tap\n"
            "Stick of a hand that holds the volume: turn it\n";
    else
        text += "Values and time: on this panel\n";
    text += "Tip in the volume: what is there; ";
    return text + (controls.oneButton ? "a tap keeps it" : "the trigger keeps it");
}

}  // namespace app::headset
