// What a sensor's noise remembers, from readings of which only smoothness is known.
//
// The quiet stretches of a record are cut into blocks; in each the signal is a cubic and the rest
// noise of covariance σ²·[s·exp(−|h|/θ) + (1 − s)·δ], with σ of its run and θ, s of the sensor. The
// restricted likelihood takes account of what the cubics carry off:
//   −2·ln L = Σ_runs N·ln(SS/N) + Σ_blocks (ln|R| + ln|XᵀR⁻¹X|),  N = Σ_blocks (n − 4),
// with SS the blocks' squares left by generalised least squares. Slow noise needs long blocks, and
// a signal that bends more than a cubic within its block passes for slow noise. So blocks get
// shorter until what they say is the same for blocks half as long: noise stays, bends fade.
// Source: Patterson & Thompson, Biometrika 58 (1971) 545.
#ifndef PLENUM_CALIBRATION_NOISE_QUIET_MEMORY_H_
#define PLENUM_CALIBRATION_NOISE_QUIET_MEMORY_H_

#include <span>
#include <vector>

#include "calibration/noise/noise_memory.h"

namespace plenum::calibration {

// Readings without a gap, at rising times, at a signal that is quiet.
struct QuietStretch {
  std::vector<double> t_s, y;
};
using QuietRecord = std::vector<QuietStretch>;  // of one run

struct QuietMemory {
  NoiseMemory memory;  // θ = 0 where white noise does as well
  struct Level {
    double sigma = 0.0, relative_error = 0.0;  // NaN for a run without blocks
  };
  std::vector<Level> levels;  // of the runs, where there is a memory
  // Memories, on a grid, that the readings are not against (99.9 %); none much longer than the
  // likeliest one or a few spacings, because what remembers for longer is not told from structure.
  std::vector<NoiseMemory> allowed;
};

// θ is looked for from 0.4 to 76 spacings.
QuietMemory MemoryOfQuiet(std::span<const QuietRecord> runs, double spacing_s);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_NOISE_QUIET_MEMORY_H_
