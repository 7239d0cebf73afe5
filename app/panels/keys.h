// All keys and what they do: one table that the window obeys, the help shows and the README
// repeats.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace app::panels {

enum class Command {
    TogglePlay,
    StepForward,
    StepBackward,
    FirstStep,
    LastStep,
    InPoint,
    OutPoint,
    NextEnding,
    Fit,
    Front,
    Back,
    Left,
    Right,
    Top,
    Bottom,
    Projection,
    StereoPreview,
    Undo,
    Redo,
    Open,
    Save,
    Screenshot,
    CopyCommandLine,
    Export,
    Headset,
    Help,
    Close
};

// Printing keys are their capital's or own ASCII code; the others are GLFW's numbers, which
// desktop/gui.cpp holds against GLFW's.
enum class Key : int {
    Space = 32,
    Escape = 256,
    Enter = 257,
    Tab = 258,
    Right = 262,
    Left = 263,
    Down = 264,
    Up = 265,
    Home = 268,
    End = 269,
    F1 = 290,
    F12 = 301,
    KeypadEnter = 335
};
constexpr Key key(char c) { return static_cast<Key>(c); }

struct Binding {
    Command command;
    Key key;
    bool ctrl = false, shift = false;
};

// A key that went down, or that is held and given again.
struct KeyPress {
    Key key;
    bool ctrl = false, shift = false, repeated = false;
};

// Of several bindings of one command, the first is the one shown.
std::span<const Binding> bindings();
// None too for a key that is held down, of a command that is given once.
std::optional<Command> commandOf(const KeyPress& press);

// It is a command about files, which no text has a use for, as it has for Ctrl+C and Ctrl+Z.
bool endsTyping(const KeyPress& press);

// What help and README show, in groups; mouse gestures too.
struct HelpLine {
    std::string_view group, keys, does;
};
std::span<const HelpLine> helpLines();

}  // namespace app::panels
