// The numbers by which a diagnosis decides, in one place.
#ifndef PLENUM_CALIBRATION_VALUES_THRESHOLDS_H_
#define PLENUM_CALIBRATION_VALUES_THRESHOLDS_H_

namespace plenum::calibration {

// A further effect is accepted where it lowers BIC by more than this. Differences above 10 count as
// very strong evidence (Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773). With n samples the χ²
// of one parameter must fall by 10 + ln n, above 16: by chance one in 20,000, among some twenty
// effects one in a thousand.
inline constexpr double kAccept = 10.0;

// Sets of effects of one size whose BIC is within this of the best are not told apart: what is
// named alone has very strong evidence against all else (same source), for noise that is not quite
// as assumed and declared numbers whose stated uncertainties are rough shift BIC by several units.
inline constexpr double kTie = 10.0;

// In a single run, where no other confirms what it shows, and where all runs together hold less
// than kFewReadings readings that are worth one each, the better set must also be better by this
// many standard deviations of the difference (closeness.h): by chance one in a hundred.
inline constexpr double kTieScatter = 2.33;
inline constexpr double kFewReadings = 150.0;

// The relative error of σ from which on the readings' noise is not believed: less than thirty
// windows showed it (noise.h).
inline constexpr double kRoughNoise = 0.2;

// The runs' clocks are taken to be off where that lowers BIC by this much more than any effect in
// their place does; the clocks count by how much of their prior the data exclude.
inline constexpr double kClock = 10.0;

// Held-out error over that of the noise up to which an explanation holds, and, squared, over what
// the uncertainty of the fitted numbers adds: where runs are few that is one number's doing in the
// main, and one in a thousand standard normal deviations squared is larger.
inline constexpr double kHoldout = 1.3;
inline constexpr double kHoldoutSpread = 10.83;

// Structure that is significant but small does not unmake an explanation: the part of the
// residual's variance above the noise, over that of the base model's, and its size over the noise.
inline constexpr double kLeftOver = 0.02;
inline constexpr double kNegligible = 0.25;

// Effects that leave more than this share of the base model's variance above the noise are not
// established, and no third effect is sought beside a pair that does. Nor are the sets of a tie.
inline constexpr double kEstablished = 0.2;

inline constexpr int kEffectsMax = 3;
inline constexpr int kSeeds = 3;  // best single effects that pairs are built on

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_VALUES_THRESHOLDS_H_
