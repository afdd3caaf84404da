#pragma once
// Numbers that compare pictures and sort measurements.

#include <span>
#include <vector>

#include "base/picture.h"

namespace cost {

/// Root mean square difference over r, g, b, of 255. Pictures of one size.
double rms(const base::Picture& a, const base::Picture& b);
/// The same of the means of 4 x 4 blocks: what an eye at a distance sees of a dithered picture.
double block_rms(const base::Picture& a, const base::Picture& b);
/// Peak signal to noise ratio in dB; 99 for equal pictures, so that it can be drawn and written.
double psnr(double rms_of_255);
/// Structural similarity of brightness, mean over 8 x 8 windows every 4 pixels: 1 = alike. [Wang et al. 2004]
double ssim(const base::Picture& a, const base::Picture& b);

/// `picture`, `factor` (1, 2, 4, 8) times as wide and high as wanted: each pixel the mean of the square of
/// side 1 round its sample point, which is the first of the factor x factor pixels.
base::Picture shrunk(const base::Picture& picture, int factor);
/// Where and how much two pictures differ: the colour of the largest difference of a channel, 0..255.
base::Picture heat_map(const base::Picture& a, const base::Picture& b);
/// Black for no difference, then purple, red, yellow, white for 255; the scale is a square root, so that
/// small ones show.
base::Rgba heat(int difference);
/// The part of `a` at (x, y).
base::Picture cropped(const base::Picture& a, int x, int y, int width, int height);

/// The middle value (mean of the two middle ones); 0 of nothing.
double median(std::vector<double> values);
/// The value below which `share` of the values lie; 0 of nothing.
double percentile(std::vector<double> values, double share);
/// Distance between the quartiles.
double spread(const std::vector<double>& values);

}  // namespace cost
