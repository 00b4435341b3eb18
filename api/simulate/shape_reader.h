// "cylinder", "muscle", "pouch" and "body" of a group: volumes by what the actuator is.
#ifndef PLENUM_API_SIMULATE_SHAPE_READER_H_
#define PLENUM_API_SIMULATE_SHAPE_READER_H_

#include <optional>
#include <string_view>

#include "api/json/reader.h"
#include "model/physics/actuator_shapes.h"

namespace plenum::api {

inline constexpr std::string_view kShapes[] = {"cylinder", "muscle", "pouch", "body"};

struct ShapeVolumes {
  model::ActuatorVolumes volumes;
  std::optional<model::ActuatorVolumes> rod_side;  // of a double-acting cylinder
};

// The volumes of the shape that the group gives; none without one, or after an error. Two shapes
// are an error. What they come to, with the formula, goes to the RemarkRecorder of the thread:
// rest volume, operating volume and expansion ratio, each at the pointer of the shape.
std::optional<ShapeVolumes> ReadShape(Reader& group);

// Whether the group gives a shape, right or wrong.
bool HasShape(Reader& group);

}  // namespace plenum::api

#endif  // PLENUM_API_SIMULATE_SHAPE_READER_H_
