// What a run writes down: the source's lowest pressure, samples, the accounts at the end.
#include <algorithm>
#include <cmath>

#include "model/integrate/simulate_root.h"
#include "model/simulate/simulate_run.h"

namespace plenum::model {
namespace {

constexpr double kThetaTolerance = 1e-14;

}  // namespace

template <class T, class Stepper>
void Run<T, Stepper>::RecordSourceLowest() {
  if (options_.record != Record::kAll) return;
  const auto lower = [&](std::size_t s, T& lowest_pa) {
    if (stepper_.state()[s] < lowest_pa) lowest_pa = stepper_.state()[s];
    const auto slope = [&](double theta) { return stepper_.Slope(theta, s); };
    const double before = slope(0.0);
    const double after = slope(1.0);
    if (before < 0.0 && after > 0.0) {
      const double theta = RootBetween(slope, 0.0, before, 1.0, after, kThetaTolerance);
      const T inside_pa = stepper_.At(theta, s);
      if (inside_pa < lowest_pa) lowest_pa = inside_pa;
    }
  };
  if (const auto source = system_.source_state()) {
    lower(*source, response_.source_lowest_pressure_pa);
  }
  if (system_
          .driven()) {  // monotone within a step, which ends at the record's points at the latest
    const T source_pa = system_.SourcePressure(stepper_.time(), stepper_.state());
    const auto lower_to = [&](T& lowest_pa) {
      if (source_pa < lowest_pa) lowest_pa = source_pa;
    };
    lower_to(response_.source_lowest_pressure_pa);
    for (std::size_t i = 0; i < valves_.size(); ++i) {
      if (valves_[i].stroke >= 0 && !system_.HeadState(i)) {
        lower_to(StrokeOfValve(valves_[i]).source_lowest_pressure_pa);
      }
    }
  }
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    const std::optional<std::size_t> head = system_.HeadState(i);
    if (valves_[i].stroke >= 0 && head) {
      lower(*head, StrokeOfValve(valves_[i]).source_lowest_pressure_pa);
    }
  }
}

template <class T, class Stepper>
double Run<T, Stepper>::SampleTime(std::size_t k) const {
  if (!options_.sample_times_s.empty()) return options_.sample_times_s[k];
  return k + 1 == sample_count_ ? options_.end_s : static_cast<double>(k) / options_.sample_hz;
}

template <class T, class Stepper>
void Run<T, Stepper>::SampleTo(double time_s, SampleFrom from) {
  while (response_.t_s.size() < sample_count_) {
    const std::size_t k = response_.t_s.size();
    const double sample_s = SampleTime(k);
    if (sample_s > time_s) return;
    if (from == SampleFrom::kStep) stepper_.StateAt(sample_s, sample_);
    TakeSample(sample_s, from == SampleFrom::kStep ? sample_ : y_);
  }
}

template <class T, class Stepper>
void Run<T, Stepper>::TakeSample(double time_s, std::span<const T> y) {
  response_.t_s.push_back(time_s);
  const bool pressures_only = options_.record == Record::kPressures;
  if (!pressures_only) system_.Look(T(time_s), y);
  for (std::size_t i = 0; i < system_.groups(); ++i) {
    GroupResponseOf<T>& group = response_.groups[i];
    group.pressure_pa.push_back(y[system_.pressure(i)]);
    if (system_.measured(i)) group.reading_pa.push_back(system_.Reading(i, y));
    if (pressures_only) continue;
    const Moment<T>& moment = system_.moment(i);
    group.volume_m3.push_back(moment.volume_m3 - system_.setup(i).dead_volume_m3);
    if (system_.heated(i)) group.temperature_k.push_back(moment.temperature_k);
    group.flow_m3_per_s.push_back(moment.line_in_m3_per_s);
    if (rig_.groups[i].inlet_after > 0) {
      group.inlet_pressure_pa.push_back(system_.InletPressure(i, T(time_s)));
    }
  }
  if (system_.has_source())
    response_.source_pressure_pa.push_back(system_.HeadPressure(0, T(time_s), y));
}

template <class T, class Stepper>
void Run<T, Stepper>::RecordEnd() {
  system_.Look(t_s_, y_);
  for (std::size_t i = 0; i < system_.groups(); ++i) {
    GroupResponseOf<T>& group = response_.groups[i];
    group.final_pressure_pa = y_[system_.pressure(i)];
    group.gas_final_m3 = system_.Stored(i, y_);
    group.energy_final_j = system_.Energy(i);
    using S = System<T>;
    group.air_drawn_m3 = system_.Of(i, S::kDrawn, y_);
    group.air_in_m3 = system_.Of(i, S::kIn, y_);
    group.air_out_m3 = system_.Of(i, S::kOut, y_);
    group.air_leaked_m3 = system_.Of(i, S::kLeaked, y_);
    group.enthalpy_in_j = system_.Of(i, S::kEnthalpyIn, y_);
    group.enthalpy_out_j = system_.Of(i, S::kEnthalpyOut, y_);
    group.wall_heat_j = system_.Of(i, S::kWallHeat, y_);
    group.work_j = system_.Of(i, S::kWork, y_);
  }
  response_.source_final_pressure_pa = system_.SourcePressure(t_s_, y_);
  response_.compressor_on_s = system_.Of(System<T>::kOnTime, y_);
  response_.compressor_air_m3 = system_.Of(System<T>::kPumpAir, y_);
  response_.compressor_energy_j = system_.Of(System<T>::kPumpEnergy, y_);
}

#define PLENUM_RECORD(T, Stepper)                                        \
  template void Run<T, Stepper>::RecordSourceLowest();                   \
  template double Run<T, Stepper>::SampleTime(std::size_t) const;        \
  template void Run<T, Stepper>::SampleTo(double, SampleFrom);           \
  template void Run<T, Stepper>::TakeSample(double, std::span<const T>); \
  template void Run<T, Stepper>::RecordEnd();
PLENUM_RECORD(double, ExplicitIntegrator<double>)
PLENUM_RECORD(double, CvodeIntegrator)
PLENUM_RECORD(Dual, ExplicitIntegrator<Dual>)
PLENUM_RECORD(WideDual, ExplicitIntegrator<WideDual>)
PLENUM_RECORD(double, ImplicitIntegrator<double>)
PLENUM_RECORD(Dual, ImplicitIntegrator<Dual>)
PLENUM_RECORD(WideDual, ImplicitIntegrator<WideDual>)
#undef PLENUM_RECORD

}  // namespace plenum::model
