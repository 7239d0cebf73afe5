// What stands under the cursor, and how far two such points are apart.
#pragma once

#include <optional>
#include <string>

#include "app/panels/form.h"

namespace app::panels {

// What is to be said of the times at which points were read, where these are not all the picture's;
// else "". `second`: another end of the ruler, whose time is told, or null.
std::string timesNote(const Reading& first, const Reading* second, const Shown& shown);

// Of longitudes and latitudes in degrees, by the great circle (haversines); heights do not count.
double kilometresApart(const glm::dvec3& a, const glm::dvec3& b);

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
