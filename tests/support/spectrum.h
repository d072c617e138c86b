// The spectrum of a sound, in three numbers.
#pragma once

#include <complex>
#include <numbers>
#include <utility>
#include <vector>

namespace scree {

struct Spectrum {
  double centroid_hz = 0.0;  ///< the mean frequency, by energy
  double below_300 = 0.0;    ///< share of the energy below 300 Hz
  double above_3000 = 0.0;   ///< and above 3 kHz
};

/// Cooley and Tukey's transform in place, of a power of two of values.
inline void transform(std::vector<std::complex<double>>& values) {
  const size_t count = values.size();
  for (size_t i = 1, j = 0; i < count; ++i) {
    size_t bit = count >> 1;
    for (; (j & bit) != 0; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(values[i], values[j]);
  }
  for (size_t length = 2; length <= count; length *= 2) {
    const std::complex<double> turn = std::polar(1.0, -2.0 * std::numbers::pi / static_cast<double>(length));
    for (size_t from = 0; from < count; from += length) {
      std::complex<double> at = 1.0;
      for (size_t i = from; i < from + length / 2; ++i, at *= turn) {
        const std::complex<double> even = values[i], odd = values[i + length / 2] * at;
        values[i] = even + odd;
        values[i + length / 2] = even - odd;
      }
    }
  }
}

/// The spectrum of samples of two sides in turn, as one.
inline Spectrum spectrum_of(const std::vector<float>& samples, double rate_hz) {
  size_t count = 1;
  while (count < samples.size() / 2) count *= 2;
  std::vector<std::complex<double>> values(count);
  for (size_t i = 0; i < samples.size() / 2; ++i)
    values[i] = static_cast<double>(samples[2 * i]) + static_cast<double>(samples[2 * i + 1]);
  transform(values);
  Spectrum spectrum;
  double energy = 0.0;
  for (size_t i = 1; i < count / 2; ++i) {
    const double hz = rate_hz * static_cast<double>(i) / static_cast<double>(count),
                 part = std::norm(values[i]);
    energy += part;
    spectrum.centroid_hz += hz * part;
    if (hz < 300.0) spectrum.below_300 += part;
    if (hz > 3000.0) spectrum.above_3000 += part;
  }
  return {spectrum.centroid_hz / energy, spectrum.below_300 / energy, spectrum.above_3000 / energy};
}

}  // namespace scree
