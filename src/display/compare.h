#pragma once
// Two pictures of the same size, pixel against pixel.

#include <cstddef>

#include "display/picture.h"

namespace display {

/// How many pixels differ in r, g or b. Pictures of different size differ everywhere: the larger one's count.
[[nodiscard]] std::size_t count_different(const Picture& a, const Picture& b);

/// `shown`, darkened to grey, with the pixels that differ from `other` in `mark`. Sizes must be equal.
[[nodiscard]] Picture mark_different(const Picture& shown, const Picture& other, Rgba mark);

}  // namespace display
