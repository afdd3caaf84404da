#pragma once
// Two pictures of the same size, pixel against pixel.

#include <cstddef>

#include "base/picture.h"

namespace display {

/// How many pixels differ in r, g or b. Pictures of different size differ everywhere: the larger one's count.
[[nodiscard]] std::size_t count_different(const base::Picture& a, const base::Picture& b);

/// `shown`, darkened to grey, with the pixels that differ from `other` in `mark`. Sizes must be equal.
[[nodiscard]] base::Picture mark_different(const base::Picture& shown, const base::Picture& other,
                                           base::Rgba mark);

}  // namespace display
