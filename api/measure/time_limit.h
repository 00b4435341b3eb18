// The time that a diagnosis may take, which a measurement may say.
#ifndef PLENUM_API_MEASURE_TIME_LIMIT_H_
#define PLENUM_API_MEASURE_TIME_LIMIT_H_

namespace plenum::api {

inline constexpr double kDiagnosisTimeS = 60.0, kDiagnosisTimeMaxS = 3600.0;
inline constexpr const char* kTimeLimitField = "time_limit_s";

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_TIME_LIMIT_H_
