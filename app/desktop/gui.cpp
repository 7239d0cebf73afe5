#include "app/desktop/gui.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>
#include <xxhash.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "app/panels/field_text.h"

namespace app::desktop {
namespace {

using panels::Key;
static_assert(static_cast<int>(Key::Space) == GLFW_KEY_SPACE &&
              static_cast<int>(Key::Escape) == GLFW_KEY_ESCAPE &&
              static_cast<int>(Key::Enter) == GLFW_KEY_ENTER &&
              static_cast<int>(Key::KeypadEnter) == GLFW_KEY_KP_ENTER &&
              static_cast<int>(Key::Tab) == GLFW_KEY_TAB &&
              static_cast<int>(Key::Up) == GLFW_KEY_UP &&
              static_cast<int>(Key::Down) == GLFW_KEY_DOWN &&
              static_cast<int>(Key::Right) == GLFW_KEY_RIGHT &&
              static_cast<int>(Key::Left) == GLFW_KEY_LEFT &&
              static_cast<int>(Key::Home) == GLFW_KEY_HOME &&
              static_cast<int>(Key::End) == GLFW_KEY_END &&
              static_cast<int>(Key::F12) == GLFW_KEY_F12 && panels::key('A') == Key{GLFW_KEY_A});

#if IMGUI_VERSION_NUM >= 18700
constexpr int kKeypadEnter = ImGuiKey_KeypadEnter;
#else
constexpr int kKeypadEnter = ImGuiKey_KeyPadEnter;
#endif

// Tab is not ImGui's: panels::Focus has it.
void mapKeys(ImGuiIO& io) {
    constexpr std::pair<int, int> kKeys[] = {
        {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
        {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
        {ImGuiKey_UpArrow, GLFW_KEY_UP},
        {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
        {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
        {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
        {ImGuiKey_Home, GLFW_KEY_HOME},
        {ImGuiKey_End, GLFW_KEY_END},
        {ImGuiKey_Insert, GLFW_KEY_INSERT},
        {ImGuiKey_Delete, GLFW_KEY_DELETE},
        {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
        {ImGuiKey_Space, GLFW_KEY_SPACE},
        {ImGuiKey_Enter, GLFW_KEY_ENTER},
        {kKeypadEnter, GLFW_KEY_KP_ENTER},
        {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
        {ImGuiKey_A, GLFW_KEY_A},
        {ImGuiKey_C, GLFW_KEY_C},
        {ImGuiKey_V, GLFW_KEY_V},
        {ImGuiKey_X, GLFW_KEY_X},
        {ImGuiKey_Y, GLFW_KEY_Y},
        {ImGuiKey_Z, GLFW_KEY_Z},
    };
    for (const auto& [imgui, glfw] : kKeys) io.KeyMap[imgui] = glfw;
}

Cursor cursorOf(ImGuiMouseCursor cursor) {
    switch (cursor) {
        case ImGuiMouseCursor_TextInput:
            return Cursor::Text;
        case ImGuiMouseCursor_ResizeEW:
            return Cursor::LeftRight;
        case ImGuiMouseCursor_ResizeNS:
            return Cursor::UpDown;
        case ImGuiMouseCursor_Hand:
            return Cursor::Hand;
        case ImGuiMouseCursor_ResizeAll:
            return Cursor::Cross;
        default:
            return Cursor::Arrow;
    }
}

// One number for all that is drawn; the font's texture alone is no part of it, and changes with the
// size of the text.
std::uint64_t looksOf(const ImDrawData& data) {
    std::uint64_t looks = 0;
    const auto take = [&](const auto* first, int count) {
        looks = XXH3_64bits_withSeed(first, static_cast<std::size_t>(count) * sizeof *first, looks);
    };
    take(&data.DisplaySize, 1);
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        take(list.VtxBuffer.Data, list.VtxBuffer.Size);
        take(list.IdxBuffer.Data, list.IdxBuffer.Size);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            take(&command.ClipRect, 1);
            take(&command.ElemCount, 1);
        }
    }
    return looks;
}

// Hands events to ImGui until one would hide what an earlier one of this frame says.
class Feed {
 public:
    explicit Feed(ImGuiIO& io) : io_(io) {}

    // False: the event belongs to the next frame.
    bool operator()(const MouseMoved& e) {
        if (button_) return false;
        io_.MousePos = {e.at.x, e.at.y};
        moved_ = true;
        return true;
    }
    bool operator()(const MouseButton& e) {
        if (button_ || moved_) return false;
        io_.MouseDown[e.button] = e.down;
        return button_ = true;
    }
    bool operator()(const Wheel& e) {
        if (button_) return false;
        io_.MouseWheel += e.by.y;
        io_.MouseWheelH += e.by.x;
        return moved_ = true;
    }
    bool operator()(const KeyChanged& e) {
        if (key_ || button_) return false;  // a field may have been pressed
        io_.KeysDown[e.key] = e.down;
        const bool own = e.key >= GLFW_KEY_LEFT_SHIFT;  // GLFW tells modifiers before their change
        io_.KeyCtrl = own ? held(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL) : e.ctrl;
        io_.KeyShift = own ? held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT) : e.shift;
        io_.KeyAlt = own ? held(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT) : e.alt;
        if (e.down && !e.alt) pressed = panels::KeyPress{Key{e.key}, e.ctrl, e.shift, e.repeated};
        return key_ = true;
    }
    bool operator()(const Character& e) {
        for (const char32_t c : panels::fieldCharacters(e.code)) io_.AddInputCharacter(c);
        return true;
    }
    bool operator()(const FocusChanged& e) {
        if (!e.focused) io_.ClearInputKeys();
        return true;
    }
    bool operator()(const Dropped& e) {
        dropped.insert(dropped.end(), e.files.begin(), e.files.end());
        return true;
    }

    std::optional<panels::KeyPress> pressed;
    std::vector<std::filesystem::path> dropped;

 private:
    bool held(int left, int right) const { return io_.KeysDown[left] || io_.KeysDown[right]; }
    ImGuiIO& io_;
    bool moved_ = false, button_ = false, key_ = false;
};

}  // namespace

Gui::Gui(Window& window, float scale) : window_(window) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
    io.ClipboardUserData = this;
    io.SetClipboardTextFn = [](void* gui, const char* text) {
        static_cast<Gui*>(gui)->window_.setClipboard(panels::meantText(text));
    };
    io.GetClipboardTextFn = [](void* gui) { return static_cast<Gui*>(gui)->pasted(); };
    mapKeys(io);
    theme_ = panels::makeTheme(scale);
    if (!ImGui_ImplOpenGL3_Init("#version 450 core"))
        throw std::runtime_error("Dear ImGui's OpenGL renderer did not start");
}

Gui::~Gui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

const char* Gui::pasted() {
    const char* const text = window_.clipboard();
    if (text == nullptr) return nullptr;
    pasted_ = panels::fieldText(text);
    return pasted_.c_str();
}

void Gui::setScale(float scale) {
    if (scale == theme_.scale) return;
    theme_ = panels::makeTheme(scale);
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
}

FrameInput Gui::beginFrame(std::chrono::nanoseconds dt) {
    ImGuiIO& io = ImGui::GetIO();
    Feed feed(io);
    std::deque<Event>& events = window_.events();
    while (!events.empty() && std::visit(feed, events.front())) events.pop_front();
    const glm::ivec2 size = window_.framebufferSize();
    io.DisplaySize = {static_cast<float>(size.x), static_cast<float>(size.y)};
    io.DeltaTime = std::max(1e-4f, std::chrono::duration<float>(dt).count());
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    return {.key = feed.pressed, .dropped = std::move(feed.dropped)};
}

void Gui::endFrame() { ImGui::EndFrame(); }

bool Gui::finishFrame() {
    window_.setCursor(cursorOf(ImGui::GetMouseCursor()));
    ImGui::Render();
    const std::uint64_t looks = looksOf(*ImGui::GetDrawData());
    return std::exchange(looks_, looks) != looks;
}

void Gui::draw() const { ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData()); }

}  // namespace app::desktop
