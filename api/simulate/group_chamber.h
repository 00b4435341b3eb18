// The actuator of a group: its volumes, as numbers, as a table or by what it is.
#ifndef PLENUM_API_SIMULATE_GROUP_CHAMBER_H_
#define PLENUM_API_SIMULATE_GROUP_CHAMBER_H_

#include <optional>

#include "api/json/reader.h"
#include "api/json/shared_fields.h"
#include "model/physics/air.h"
#include "model/physics/chamber.h"

namespace plenum::api {

// Whether the actuator may be evacuated: its operating pressure is then below ambient, its
// expansion ratio at most 1, and the chamber mirrored (model/physics/chamber.h).
enum class Vacuum { kRefused, kAllowed };

// "operating_pressure_kpa_gauge" and one of
// - "rest_volume_ml" and "expansion_ratio",
// - "pressure_volume", a table; the rest volume is that of the table at ambient pressure, and a
//   stated one must agree with it within 5 %,
// - "cylinder", "muscle", "pouch" or "body" (shape_reader.h); the volumes and their formula go to
//   the RemarkRecorder of the thread.
//
// A double-acting cylinder has another chamber on the side of the rod: it goes to `rod_side`; where
// that is null it is an error.
model::Chamber ReadChamber(Reader& group, const model::Ambient& ambient,
                           Vacuum vacuum = Vacuum::kRefused,
                           std::optional<model::Chamber>* rod_side = nullptr,
                           double operating_max_kpa = kRigGaugeMaxKpa);

// "low_pressure_kpa_gauge" of an actuator under pressure, where it rests below ambient; 0: it does
// not. Fails for an evacuated one, for both sides of a cylinder, and where no volume is left.
void ReadLowPressure(Reader& group, const model::Ambient& ambient, bool double_acting,
                     model::Chamber& chamber);

}  // namespace plenum::api

#endif  // PLENUM_API_SIMULATE_GROUP_CHAMBER_H_
