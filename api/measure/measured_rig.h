// The rig of a measurement/1 document: what stands on the bench, as declared (contract.md).
#ifndef PLENUM_API_MEASURE_MEASURED_RIG_H_
#define PLENUM_API_MEASURE_MEASURED_RIG_H_

#include <optional>
#include <string>
#include <vector>

#include "api/json/reader.h"
#include "api/measure/rig/measured_line.h"
#include "calibration/values/dataset.h"

namespace plenum::api {

// What a rig declares, before the run adds its own. Pressures absolute.
struct MeasuredRig {
  model::Ambient ambient;
  model::Chamber chamber;  // of several the one that the run's pressure is of
  calibration::Several several;
  std::vector<calibration::LinePiece> line;
  model::Gas gas = model::Gas::kAir;
  calibration::Supply supply = calibration::Supply::kNone;
  std::optional<double> source_pressure_pa, exhaust_pressure_pa;
  model::CompressorCurve compressor;
  double reservoir_volume_m3 = 0.0;
  calibration::Sensor sensor;
  std::vector<MeasuredInRig> measured;
};

// The document's `shared` rig with a run's `own` merged over it (JSON merge patch; null: none).
// Errors name the document that holds the place: `own_pointer` or /rig. What is wrong with the
// shared rig is reported once, however many runs use it.
MeasuredRig ReadRigOfRun(const Json& shared, const Json* own, const std::string& own_pointer,
                         Errors& errors);

// Gauge pressures down to an absolute 0, and what they are taken for: above it.
Range PressuresFrom0(const model::Ambient& ambient);
double PaFromKpaGaugeOf(double kpa, const model::Ambient& ambient);

// Lets pass what people write into such files for themselves: note, date, license, ...
void AllowRemarks(Reader& reader);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_MEASURED_RIG_H_
