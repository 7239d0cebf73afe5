// What stands under the cursor, and how far two such points are apart.
#pragma once

#include <optional>

#include "app/panels/form.h"

namespace app::panels {

class ProbePage {
 public:
    void draw(PanelContext& context, const Rect& at);
    // What a probe found. `ruler`: as another end of the ruler.
    void take(const std::optional<Reading>& reading, bool ruler);
    void clear() { first_.reset(), second_.reset(); }

    const std::optional<Reading>& first() const { return first_; }
    const std::optional<Reading>& second() const { return second_; }

 private:
    std::optional<Reading> first_, second_;
};

}  // namespace app::panels
