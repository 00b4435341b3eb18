#include "calibration/values/crossing.h"

#include <algorithm>
#include <utility>

namespace plenum::calibration {
namespace {

constexpr double kLeastPressurePa = 1e-3;

}  // namespace

bool Evacuates(const Run& run) {
  return run.supply == Supply::kRegulated && run.source_pressure_pa < run.ambient.pressure_pa;
}

bool RecordsNode(const Run& run) {
  return run.supply == Supply::kFlow &&
         !(run.channels.source_pressure_pa.empty() && run.channels.inlet_pressure_pa.empty());
}

LinePiece AsCrossed(LinePiece piece, const Run& run) {
  if (Evacuates(run)) std::swap(piece.fill, piece.exhaust);
  return piece;
}

model::ValveState AsCrossed(model::ValveState state, const Run& run) {
  using enum model::ValveState;
  if (state == kHold || !Evacuates(run)) return state;
  return state == kInflate ? kDeflate : kInflate;
}

double SourcePressure(const Run& run, double factor, double shift_pa) {
  const double ambient_pa = run.ambient.pressure_pa;
  return std::max(kLeastPressurePa,
                  ambient_pa + shift_pa + factor * (run.source_pressure_pa - ambient_pa));
}

double ExhaustPressure(const Run& run, double shift_pa) {
  const double declared_pa =
      run.exhaust_pressure_pa > 0.0 ? run.exhaust_pressure_pa : run.ambient.pressure_pa;
  return std::max(kLeastPressurePa, declared_pa + shift_pa);
}

}  // namespace plenum::calibration
