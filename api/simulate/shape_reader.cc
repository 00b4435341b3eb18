#include "api/simulate/shape_reader.h"

#include <cmath>
#include <numbers>
#include <string>

#include "api/json/remarks.h"
#include "api/json/shared_fields.h"
#include "api/json/units.h"
#include "api/json/words.h"

namespace plenum::api {
namespace {

const Range kLengthMm{1, 1e5};
const Range kVolumeMl{0.01, 1e6};  // of what is at the operating pressure
constexpr double kBraidAngleDeg = 25.0;

// A shape read: what it comes to, and how.
struct Shape {
  model::ActuatorVolumes volumes;
  std::string rest_formula, operating_formula;
  std::optional<model::ActuatorVolumes> rod_side = {};
  std::string rod_formula = {};
};

std::string FlatFormula() {
  return "flat at rest, taken as " + Decimal(model::kFlatShare) + " of the operating volume";
}

// `V/V0` at most kExpansionMax: the dead volume must not be less than this share of the swept one.
constexpr double kDeadShareMin = 1.0 / (kExpansionMax - 1.0);

Shape ReadCylinder(Reader& cylinder) {
  const double bore_m = MFromMm(cylinder.Number("bore_mm", {0.5, 1000}));
  const double stroke_m = MFromMm(cylinder.Number("stroke_mm", kLengthMm));
  const auto rod_mm = cylinder.OptionalNumber("rod_mm", {0.1, 1000});
  if (rod_mm && MFromMm(*rod_mm) >= bore_m)
    cylinder.Fail("rod_mm", "must be less than the bore of " + Decimal(Rounded(bore_m / kMPerMm)) +
                                " mm, not " + Decimal(*rod_mm));
  const bool both = cylinder.Choice("acting", {"single", "double"}, "single") == "double";
  const double swept_ml = MlFromM3(model::CylinderVolumes(bore_m, stroke_m, 0.0).operating_m3);
  const auto given_ml = cylinder.OptionalNumber("dead_volume_ml", {1e-4, 1e6});
  if (given_ml && *given_ml < kDeadShareMin * swept_ml)
    cylinder.Fail("dead_volume_ml", "must be ≥ " + Decimal(Rounded(kDeadShareMin * swept_ml)) +
                                        " mL with a swept volume of " + Decimal(Rounded(swept_ml)) +
                                        " mL, not " + Decimal(*given_ml));
  const double dead_ml = given_ml.value_or(model::kDeadShare * swept_ml);
  Shape shape;
  shape.volumes = model::CylinderVolumes(bore_m, stroke_m, M3FromMl(dead_ml));
  shape.rest_formula = given_ml ? "dead volume"
                                : "dead volume, taken as " + Decimal(model::kDeadShare) +
                                      " of the swept volume: dead_volume_ml is not given";
  shape.operating_formula = "dead volume + π·bore²/4·stroke, full stroke";
  if (!both) return shape;
  const double rod_m = MFromMm(rod_mm.value_or(0.0));
  shape.rod_side = model::RodSideVolumes(bore_m, rod_m, stroke_m, M3FromMl(dead_ml));
  shape.rod_formula = std::string("dead volume + π·(bore² − rod²)/4·stroke") +
                      (rod_mm ? "" : ", a rod of 0 mm: rod_mm is not given");
  return shape;
}

Shape ReadMuscle(Reader& muscle) {
  const double length_m = MFromMm(muscle.Number("length_mm", kLengthMm));
  const double diameter_m = MFromMm(muscle.Number("diameter_mm", {0.5, 1000}));
  const auto given_deg = muscle.OptionalNumber("braid_angle_deg", {5, 54});
  const double angle_deg = given_deg.value_or(kBraidAngleDeg);
  const double angle_rad = angle_deg * std::numbers::pi / 180.0;
  const double greatest = Rounded(model::GreatestContraction(angle_rad));
  const double contraction = muscle.Number("contraction", Above(0, 1));
  if (contraction > greatest)
    muscle.Fail("contraction",
                "must be > 0 and ≤ " + Decimal(std::floor(greatest * 1e4) / 1e4) +
                    " with a braid angle of " + Decimal(angle_deg) +
                    "°: there the braid stands at 54.7° and contracts no further; not " +
                    Decimal(contraction));
  Shape shape;
  shape.volumes = model::MuscleVolumes(length_m, diameter_m, angle_rad, contraction);
  shape.rest_formula = "π·D²/4·L";
  shape.operating_formula =
      "rest volume · (1−κ)·[1 − (1−κ)²·cos²θ]/sin²θ, κ = " + Decimal(contraction) +
      ", θ = " + Decimal(angle_deg) + "°" + (given_deg ? "" : ": braid_angle_deg is not given");
  return shape;
}

Shape ReadPouch(Reader& pouch) {
  const double width_m = MFromMm(pouch.Number("width_mm", kLengthMm));
  const double length_m = MFromMm(pouch.Number("length_mm", kLengthMm));
  const int cells = pouch.Integer("cells", 1, 1000, 1);
  Shape shape;
  shape.volumes = model::PouchVolumes(width_m, length_m);
  shape.volumes.rest_m3 *= cells;
  shape.volumes.operating_m3 *= cells;
  shape.rest_formula = FlatFormula();
  shape.operating_formula = Decimal(cells) +
                            " × w³·[h/(π·w) − 0.142·(1 − 10^(−h/w))], w the shorter and h the "
                            "longer side of a cell";
  return shape;
}

Shape ReadBody(Reader& body) {
  Shape shape;
  const double diameter_m = MFromMm(body.Number("diameter_mm", {0.5, 2000}));
  shape.volumes = model::BodyVolumes(diameter_m, body.Number("length_m", {1e-3, 1e3}));
  shape.rest_formula = FlatFormula();
  shape.operating_formula = "π·D²/4·L, grown to its full length";
  return shape;
}

void TellVolumes(const std::string& pointer, const Json& given, const Shape& shape) {
  RemarkRecorder* remarks = RemarkRecorder::Current();
  if (remarks == nullptr) return;
  const auto tell = [&](const char* name, double value, const char* unit,
                        const std::string& formula) {
    remarks->Understood(pointer, {{"given", given},
                                  {"name", name},
                                  {"value", Number(value)},
                                  {"unit", unit},
                                  {"formula", formula}});
  };
  const auto& [rest_m3, operating_m3] = shape.volumes;
  tell("rest_volume_ml", MlFromM3(rest_m3), "mL", shape.rest_formula);
  tell("operating_volume_ml", MlFromM3(operating_m3), "mL", shape.operating_formula);
  tell("expansion_ratio", operating_m3 / rest_m3, "", "operating volume / rest volume");
  if (!shape.rod_side) return;
  tell("operating_volume_ml of the rod side", MlFromM3(shape.rod_side->operating_m3), "mL",
       shape.rod_formula);
  remarks->Warn(pointer,
                "counts as two independent chambers, one filled while the other is "
                "emptied: no piston, load or friction");
}

}  // namespace

bool HasShape(Reader& group) {
  bool has = false;
  for (const std::string_view name : kShapes) has = group.Has(name) || has;
  return has;
}

std::optional<ShapeVolumes> ReadShape(Reader& group) {
  constexpr Shape (*kRead[])(Reader&) = {ReadCylinder, ReadMuscle, ReadPouch, ReadBody};
  static_assert(std::size(kRead) == std::size(kShapes));
  std::optional<ShapeVolumes> volumes;
  std::string_view first;
  for (std::size_t i = 0; i < std::size(kShapes); ++i) {
    if (!group.Has(kShapes[i])) continue;
    if (!first.empty())
      group.Fail(kShapes[i], "give either " + std::string(first) + " or " +
                                 std::string(kShapes[i]) + ", not both");
    first = kShapes[i];
    const std::size_t errors_before = group.errors().size();
    Reader reader = group.Object(kShapes[i]);
    const Shape shape = kRead[i](reader);
    reader.Finish();
    if (group.errors().size() > errors_before) continue;
    const double ml = MlFromM3(shape.volumes.operating_m3);
    if (!kVolumeMl.Contains(ml)) {
      group.Fail(kShapes[i], "has an operating volume of " + Decimal(Rounded(ml)) +
                                 " mL; it must be " + kVolumeMl.Text());
      continue;
    }
    TellVolumes(group.Pointer(kShapes[i]), *group.Raw(kShapes[i]), shape);
    volumes = {shape.volumes, shape.rod_side};
  }
  return volumes;
}

}  // namespace plenum::api
