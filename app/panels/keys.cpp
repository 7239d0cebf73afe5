#include "app/panels/keys.h"

#include <algorithm>
#include <array>

namespace app::panels {
namespace {

constexpr std::array kBindings = {
    Binding{Command::TogglePlay, Key::Space},  Binding{Command::StepBackward, key(',')},
    Binding{Command::StepBackward, Key::Left}, Binding{Command::StepForward, key('.')},
    Binding{Command::StepForward, Key::Right}, Binding{Command::FirstStep, Key::Home},
    Binding{Command::LastStep, Key::End},      Binding{Command::InPoint, key('I')},
    Binding{Command::OutPoint, key('O')},      Binding{Command::NextEnding, key('L')},
    Binding{Command::Fit, key('F')},           Binding{Command::Front, key('1')},
    Binding{Command::Back, key('2')},          Binding{Command::Left, key('3')},
    Binding{Command::Right, key('4')},         Binding{Command::Top, key('5')},
    Binding{Command::Bottom, key('6')},        Binding{Command::Projection, key('P')},
    Binding{Command::StereoPreview, key('S')}, Binding{Command::Undo, key('Z'), true},
    Binding{Command::Redo, key('Y'), true},    Binding{Command::Redo, key('Z'), true, true},
    Binding{Command::Open, key('O'), true},    Binding{Command::Save, key('S'), true},
    Binding{Command::Export, key('E'), true},  Binding{Command::CopyCommandLine, key('C'), true},
    Binding{Command::Headset, key('H'), true}, Binding{Command::Screenshot, Key::F12},
    Binding{Command::Help, key('H')},          Binding{Command::Help, Key::F1},
    Binding{Command::Close, Key::Escape},
};

constexpr std::array kHelp = {
    HelpLine{"Time", "Space", "play or pause"},
    HelpLine{"Time", ",  .", "one step back, forward (also ← →)"},
    HelpLine{"Time", "Home  End", "first step, last step"},
    HelpLine{"Time", "I  O", "play from here, play up to here"},
    HelpLine{"Time", "L", "at the end: stop, start again, or turn round"},
    HelpLine{"View", "drag", "turn"},
    HelpLine{"View", "Shift + drag, middle drag", "move"},
    HelpLine{"View", "wheel", "zoom to the cursor"},
    HelpLine{"View", "rest on a point", "its value, position and index"},
    HelpLine{"View", "double click", "keep that: probe the point under the cursor"},
    HelpLine{"View", "F", "fit all of it"},
    HelpLine{"View", "1 2 3 4 5 6", "from the front, back, left, right, top, bottom"},
    HelpLine{"View", "P", "perspective or orthographic"},
    HelpLine{"View", "S", "both eyes side by side"},
    HelpLine{"Values", "drag on the histogram", "a new range of the selected layer"},
    HelpLine{"Values", "Shift + drag", "a new layer"},
    HelpLine{"Values", "drag an end, a band", "change a range, move it"},
    HelpLine{"Values", "click, drag across on the map", "go to a time"},
    HelpLine{"Values", "wheel, double click", "zoom the values, all of them again"},
    HelpLine{"Controls", "Tab  Shift + Tab", "to the next control, to the one before"},
    HelpLine{"Controls", "Enter, Space", "press it; type in a field"},
    HelpLine{"Controls", "↑ ↓ ← →", "change it, or go to what lies beside it"},
    HelpLine{"Controls", "Shift + ↑ ↓ ← →", "change it by ten times as much"},
    HelpLine{"Controls", "Esc", "leave it: keys are the picture's again"},
    HelpLine{"File", "Ctrl+O  Ctrl+S", "open, save the session"},
    HelpLine{"File", "Ctrl+Z  Ctrl+Y", "undo, redo (also Ctrl+Shift+Z)"},
    HelpLine{"File", "F12", "screenshot"},
    HelpLine{"File", "Ctrl+E", "export the animation"},
    HelpLine{"File", "Ctrl+C", "copy the command line of this picture"},
    HelpLine{"File", "Ctrl+H", "into the headset"},
    HelpLine{"File", "H  Esc", "this help, close it"},
};

bool repeats(Command command) {
    return command == Command::StepForward || command == Command::StepBackward ||
           command == Command::Undo || command == Command::Redo;
}

}  // namespace

std::span<const Binding> bindings() { return kBindings; }

std::optional<Command> commandOf(const KeyPress& press) {
    const auto found = std::find_if(kBindings.begin(), kBindings.end(), [&](const Binding& b) {
        return b.key == press.key && b.ctrl == press.ctrl && b.shift == press.shift;
    });
    if (found == kBindings.end() || (press.repeated && !repeats(found->command)))
        return std::nullopt;
    return found->command;
}

bool endsTyping(const KeyPress& press) {
    const auto command = commandOf(press);
    return command == Command::Open || command == Command::Save || command == Command::Export ||
           command == Command::Screenshot;
}

std::span<const HelpLine> helpLines() { return kHelp; }

}  // namespace app::panels
