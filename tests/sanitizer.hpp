// SPDX-License-Identifier: Apache-2.0
// Which sanitizer this build runs under.
#pragma once

namespace evigrid::testing {
#if defined(__SANITIZE_THREAD__)
inline constexpr bool kThreadSanitizer = true;
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
inline constexpr bool kThreadSanitizer = true;
#else
inline constexpr bool kThreadSanitizer = false;
#endif
#else
inline constexpr bool kThreadSanitizer = false;
#endif
}  // namespace evigrid::testing
