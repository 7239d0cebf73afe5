// How many random cases a test tries.
#pragma once

namespace tests {

// What is tested.
#ifdef ISOCHRON_SANITIZED
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

// An eighth of them where each takes eight times as long; the first are the same.
constexpr int rounds(int count) { return kSanitized ? count / 8 : count; }

}  // namespace tests
