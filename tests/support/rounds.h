// How many random cases a test tries.
#pragma once

namespace tests {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kSanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool kSanitized = false;
#endif

// An eighth of them where each takes eight times as long; the first are the same.
constexpr int rounds(int count) { return kSanitized ? count / 8 : count; }

}  // namespace tests
