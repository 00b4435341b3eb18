// What one request may ask for, wherever its kind of field is read; ranges of single numbers stand
// where they are read.
#ifndef PLENUM_API_JSON_REQUEST_LIMITS_H_
#define PLENUM_API_JSON_REQUEST_LIMITS_H_

#include <cstddef>

namespace plenum::api {

inline constexpr std::size_t kJsonDepthMax = 64;
// What the values of a document take in memory, about sixteen bytes a number.
inline constexpr std::size_t kJsonBytesMax = 16 << 20;
inline constexpr std::size_t kResultBytesMax = 1 << 30;   // of an answer with its record, on a disk
inline constexpr std::size_t kErrorsCollectedMax = 1000;  // of one request
inline constexpr std::size_t kErrorsReportedMax = 100;    // of those, with a count of the rest
inline constexpr double kTimeMaxS = 1e6;                  // of a reading or a command
inline constexpr int kDiagnosisSecondsMax = 3600;
inline constexpr std::size_t kTextCharactersMax = 200;
inline constexpr std::size_t kGroupsMax = 16;
inline constexpr std::size_t kCommandsMax = 100'000;  // of a valve's schedule
inline constexpr std::size_t kEffectsMax = 100;
inline constexpr std::size_t kTablePointsMax = 1000;  // of a curve
inline constexpr std::size_t kSimulationSamplesMax = 200'000;
inline constexpr int kSimulationSecondsMax = 60;
inline constexpr int kEvaluationSecondsMax = 60;
inline constexpr std::size_t kMapAxisMax = 1000;
inline constexpr int kMapPointsMax = 100'000;
inline constexpr int kMapPointsCompressorMax = 2'000;  // each is simulated
inline constexpr int kMapSecondsMax = 60;
inline constexpr std::size_t kRunsMax = 1000;
inline constexpr std::size_t kRunSamplesMax = 200'000;
inline constexpr int kDesignsMax = 500;
inline constexpr double kDesignSecondsMax = 3600;
inline constexpr std::size_t kExcludedMax = 100'000;
inline constexpr int kPageMax = 1000;
inline constexpr std::size_t kSweepPatchesMax = 256;
inline constexpr std::size_t kSweepBytesMax = 32 << 20;  // of all merged requirements together
inline constexpr std::size_t kSweepFieldsMax = 20;       // that its table shows

}  // namespace plenum::api

#endif  // PLENUM_API_JSON_REQUEST_LIMITS_H_
