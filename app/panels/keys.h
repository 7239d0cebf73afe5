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
    Help,
    Close
};

// Printing keys are their capital's or own ASCII code; the others are GLFW's numbers, which
// input.cpp holds against GLFW's.
enum class Key : int {
    Space = 32,
    Escape = 256,
    Right = 262,
    Left = 263,
    Home = 268,
    End = 269,
    F12 = 301
};
constexpr Key key(char c) { return static_cast<Key>(c); }

struct Binding {
    Command command;
    Key key;
    bool ctrl = false, shift = false;
};

// Of several bindings of one command, the first is the one shown.
std::span<const Binding> bindings();
std::optional<Command> commandOf(Key key, bool ctrl, bool shift);

// What help and README show, in groups; mouse gestures too.
struct HelpLine {
    std::string_view group, keys, does;
};
std::span<const HelpLine> helpLines();

}  // namespace app::panels
