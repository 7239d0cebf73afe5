#include "app/panels/recovery_offer.h"

#include "app/choices/camera.h"
#include "app/panels/widgets.h"

namespace app::panels {

float drawRecoveryOffer(PanelContext& context, const std::filesystem::path& session) {
    const Theme& theme = context.theme;
    const float s = theme.scale;
    const RecoveryOfferLayout at = recoveryOfferLayout(
        context.layout.picture, s, glm::vec2(legendOf(context.exploration.explorer())));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(im(at.whole.min), im(at.whole.max), faded(kField, 0.95f), 16 * s);
    list.AddRect(im(at.whole.min), im(at.whole.max), kLine, 16 * s);
    const float left = at.whole.min.x + 14 * s;
    text(theme, {left, at.whole.centre().y},
         fitting(*theme.text, "The last session broke off", at.goOn.min.x - left - 8 * s));
    if (textButton(theme, "##goOn", at.goOn, "Go on", true)) context.requests.open = {session};
    if (iconButton(theme, "##discardLeft", at.discard, Icon::Remove, "Discard it"))
        context.requests.discardLeft = true;
    return at.whole.max.y;
}

}  // namespace app::panels
