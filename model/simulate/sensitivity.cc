#include "model/simulate/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "model/simulate/simulate_run.h"
#include "model/simulate/simulate_validate.h"

namespace plenum::model {
namespace {

class Collector {
 public:
  void Add(std::string name, const double& number) {
    numbers.push_back({std::move(name), &number});
  }
  void AddElement(const std::string& name, const FlowElement& element) {
    Add(name + ".sonic_conductance_m3_per_s_pa", element.sonic_conductance_m3_per_s_pa);
    Add(name + ".critical_ratio", element.critical_ratio);
    Add(name + ".cracking_pressure_pa", element.cracking_pressure_pa);
  }
  void AddElements(const std::string& name, const std::vector<FlowElement>& elements) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      AddElement(name + "[" + std::to_string(i) + "]", elements[i]);
    }
  }
  std::vector<RigNumber> numbers;
};

void AddSource(const NoSource&, Collector&) {}

void AddSource(const RegulatedSource& source, Collector& all) {
  all.Add("source.pressure_pa", source.pressure_pa);
  if (source.regulator) all.AddElement("source.regulator", *source.regulator);
}

void AddSource(const ReservoirSource& source, Collector& all) {
  all.Add("source.volume_m3", source.volume_m3);
  if (source.volume_rising_m3 > 0.0) all.Add("source.volume_rising_m3", source.volume_rising_m3);
  all.Add("source.initial_pressure_pa", source.initial_pressure_pa);
  all.Add("source.duty", source.duty);
  all.Add("source.stop_pressure_pa", source.stop_pressure_pa);
}

void AddSource(const PumpSource& source, Collector& all) { all.Add("source.duty", source.duty); }

void AddSource(const DrivenSource& source, Collector& all) {
  all.Add("source.factor", source.factor);
}

void AddGroup(const std::string& name, const GroupRig& group, Collector& all) {
  const Chamber& chamber = group.chamber;
  if (chamber.volume_curve.empty()) {
    all.Add(name + "chamber.rest_volume_m3", chamber.rest_volume_m3);
    all.Add(name + "chamber.expansion_ratio", chamber.expansion_ratio);
  }
  all.Add(name + "chamber.operating_pressure_pa", chamber.operating_pressure_pa);
  all.Add(name + "chamber.dead_volume_m3", chamber.dead_volume_m3);
  all.AddElements(name + "fill", group.fill);
  all.AddElements(name + "exhaust", group.exhaust);
  for (const Effect& effect : group.effects) {
    const auto specs = effect.spec->parameters;
    for (std::size_t i = 0; i < specs.size(); ++i) {
      const std::string id(effect.spec->id);
      all.Add(name + id + "." + std::string(specs[i].name), effect.parameters[i]);
    }
  }
  if (group.initial_temperature_k > 0.0) {
    all.Add(name + "initial_temperature_k", group.initial_temperature_k);
  }
}

// What stays the same number in the rig of a full stroke.
std::vector<RigNumber> NumbersOfParts(const Rig& rig) {
  Collector all;
  all.Add("ambient.pressure_pa", rig.ambient.pressure_pa);
  all.Add("ambient.temperature_k", rig.ambient.temperature_k);
  if (rig.exhaust_pressure_pa > 0.0) all.Add("exhaust_pressure_pa", rig.exhaust_pressure_pa);
  std::visit([&](const auto& source) { AddSource(source, all); }, rig.source);
  for (std::size_t i = 0; i < rig.groups.size(); ++i) {
    AddGroup("groups[" + std::to_string(i) + "].", rig.groups[i], all);
  }
  for (std::size_t i = 0; i < rig.links.size(); ++i) {
    all.AddElements("links[" + std::to_string(i) + "].fill", rig.links[i].fill);
    all.AddElements("links[" + std::to_string(i) + "].back", rig.links[i].back);
  }
  return all.numbers;
}

// A value of the table by which a reservoir's pump delivers.
bool IsDelivery(const Rig& rig, const double* number) {
  const auto* reservoir = std::get_if<ReservoirSource>(&rig.source);
  if (!reservoir) return false;
  const std::span<const double> values = reservoir->compressor.free_air_m3_per_s.y();
  return std::any_of(values.begin(), values.end(),
                     [&](const double& value) { return &value == number; });
}

std::string WhyRefused(const Rig& rig, std::span<const Direction> directions) {
  const std::vector<RigNumber> numbers = DifferentiableNumbers(rig);
  for (std::size_t j = 0; j < directions.size(); ++j) {
    const std::string name = "parameters[" + std::to_string(j) + "]";
    for (const WeightedNumber& moved : directions[j]) {
      for (const GroupRig& group : rig.groups) {
        if (moved.number == &group.chamber.ambient_pressure_pa) {
          return name + " is a copy of ambient.pressure_pa, must be ambient.pressure_pa itself";
        }
      }
      const bool known = std::any_of(numbers.begin(), numbers.end(),
                                     [&](const RigNumber& n) { return n.number == moved.number; });
      if (!known && !IsDelivery(rig, moved.number)) {
        return name +
               " is not the address of a differentiable number of the rig, must be one of "
               "DifferentiableNumbers";
      }
      if (!std::isfinite(moved.weight)) return name + " has a weight that is not finite";
    }
  }
  return {};
}

// Copies the response with `part` of each of its numbers: the value, or one derivative.
template <class Part>
class Projection {
 public:
  explicit Projection(Part part) : part_(part) {}

  template <class T>
  Response operator()(const ResponseOf<T>& dual) const {
    Response response;
    response.status = dual.status;
    response.detail = dual.detail;
    response.t_s = dual.t_s;
    for (const auto& group : dual.groups) response.groups.push_back(OfGroup(group));
    response.source_pressure_pa = Of(dual.source_pressure_pa);
    response.source_final_pressure_pa = part_(dual.source_final_pressure_pa);
    response.source_lowest_pressure_pa = part_(dual.source_lowest_pressure_pa);
    response.compressor_on_s = part_(dual.compressor_on_s);
    response.compressor_air_m3 = part_(dual.compressor_air_m3);
    response.compressor_energy_j = part_(dual.compressor_energy_j);
    for (const auto& stroke : dual.strokes) response.strokes.push_back(OfStroke(stroke));
    response.steps = dual.steps;
    response.stiff = dual.stiff;
    return response;
  }

 private:
  template <class T>
  std::vector<double> Of(const std::vector<T>& numbers) const {
    std::vector<double> parts(numbers.size());
    std::transform(numbers.begin(), numbers.end(), parts.begin(), part_);
    return parts;
  }
  template <class T>
  GroupResponse OfGroup(const GroupResponseOf<T>& group) const {
    return {.name = group.name,
            .pressure_pa = Of(group.pressure_pa),
            .reading_pa = Of(group.reading_pa),
            .volume_m3 = Of(group.volume_m3),
            .temperature_k = Of(group.temperature_k),
            .flow_m3_per_s = Of(group.flow_m3_per_s),
            .inlet_pressure_pa = Of(group.inlet_pressure_pa),
            .final_pressure_pa = part_(group.final_pressure_pa),
            .air_drawn_m3 = part_(group.air_drawn_m3),
            .air_in_m3 = part_(group.air_in_m3),
            .air_out_m3 = part_(group.air_out_m3),
            .air_leaked_m3 = part_(group.air_leaked_m3),
            .gas_start_m3 = part_(group.gas_start_m3),
            .gas_final_m3 = part_(group.gas_final_m3),
            .energy_start_j = part_(group.energy_start_j),
            .energy_final_j = part_(group.energy_final_j),
            .enthalpy_in_j = part_(group.enthalpy_in_j),
            .enthalpy_out_j = part_(group.enthalpy_out_j),
            .wall_heat_j = part_(group.wall_heat_j),
            .work_j = part_(group.work_j)};
  }
  template <class T>
  Stroke OfStroke(const StrokeOf<T>& stroke) const {
    return {.group = stroke.group,
            .state = stroke.state,
            .command_s = part_(stroke.command_s),
            .start_pressure_pa = part_(stroke.start_pressure_pa),
            .source_start_pressure_pa = part_(stroke.source_start_pressure_pa),
            .source_lowest_pressure_pa = part_(stroke.source_lowest_pressure_pa),
            .to_target_s = part_(stroke.to_target_s),
            .to_operating_s = part_(stroke.to_operating_s)};
  }
  Part part_;
};

// The rig's run in numbers T. `stiff`: by the implicit method; set where it turned out to be
// needed.
template <class T>
ResponseOf<T> RunAlong(const Rig& rig, const SimulateOptions& options, const Lift& lift,
                       bool& stiff) {
  if (!stiff) {
    Run<T, ExplicitIntegrator<T>> run(rig, options, RunUntil::kEnd, lift);
    ResponseOf<T> response = run.Execute();
    stiff = run.stiff();
    if (!stiff) return response;
  }
  const SimulateOptions damped = DampedOptions(options);
  Run<T, ImplicitIntegrator<T>> run(rig, damped, RunUntil::kEnd, lift);
  ResponseOf<T> response = run.Execute();
  response.stiff = true;
  return response;
}

// How many parameters the next run takes of those that are left.
std::size_t NextWidth(std::size_t left) {
  const auto runs = [&](std::size_t width) { return (left + width - 1) / width; };
  return runs(kWideDirections) < runs(kDirections) ? kWideDirections : kDirections;
}

// Runs the rig with the seeds of one chunk of directions after the other. `take` sees each chunk's
// response and how many directions it has.
template <class Take>
void ForEachChunk(const Rig& rig, const SimulateOptions& options,
                  std::span<const Direction> directions, const Take& take) {
  bool stiff =
      options.integrator == Integrator::kCvode || options.integrator == Integrator::kImplicit;
  std::size_t first = 0;
  do {
    const std::size_t width = NextWidth(directions.size() - first);
    const std::size_t count = std::min(width, directions.size() - first);
    std::vector<Seed> seeds;
    for (std::size_t j = 0; j < count; ++j) {
      for (const WeightedNumber& moved : directions[first + j]) {
        seeds.push_back({moved.number, static_cast<int>(j), moved.weight});
      }
    }
    const auto done = [&](const auto& response) {
      take(response, count);
      return response.status == SimulateStatus::kDone;
    };
    const Lift lift(seeds);
    if (!(width == kDirections ? done(RunAlong<Dual>(rig, options, lift, stiff))
                               : done(RunAlong<WideDual>(rig, options, lift, stiff))))
      return;
    first += width;
  } while (first < directions.size());
}

bool Finite(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

bool AllFinite(const Response& r) {
  const auto stroke_finite = [](const Stroke& s) {
    return Finite({s.command_s, s.start_pressure_pa, s.source_start_pressure_pa,
                   s.source_lowest_pressure_pa, s.to_target_s, s.to_operating_s});
  };
  const auto group_finite = [](const GroupResponse& g) {
    return Finite(g.pressure_pa) && Finite(g.reading_pa) && Finite(g.volume_m3) &&
           Finite(g.temperature_k) && Finite(g.flow_m3_per_s) && Finite(g.inlet_pressure_pa) &&
           Finite({g.final_pressure_pa, g.air_drawn_m3, g.air_in_m3, g.air_out_m3, g.air_leaked_m3,
                   g.gas_start_m3, g.gas_final_m3, g.energy_start_j, g.energy_final_j,
                   g.enthalpy_in_j, g.enthalpy_out_j, g.wall_heat_j, g.work_j});
  };
  return std::all_of(r.strokes.begin(), r.strokes.end(), stroke_finite) &&
         std::all_of(r.groups.begin(), r.groups.end(), group_finite) &&
         Finite(r.source_pressure_pa) &&
         Finite({r.source_final_pressure_pa, r.compressor_on_s, r.compressor_air_m3,
                 r.compressor_energy_j});
}

}  // namespace

std::vector<RigNumber> DifferentiableNumbers(const Rig& rig) {
  Collector all;
  all.numbers = NumbersOfParts(rig);
  for (std::size_t i = 0; i < rig.groups.size(); ++i) {
    const GroupRig& group = rig.groups[i];
    const std::string name = "groups[" + std::to_string(i) + "].";
    all.Add(name + "initial_pressure_pa", group.initial_pressure_pa);
    for (std::size_t k = 0; k < group.schedule.size(); ++k) {
      all.Add(name + "schedule[" + std::to_string(k) + "].time_s", group.schedule[k].time_s);
    }
  }
  return all.numbers;
}

SensitivityResponse SimulateAlongDirections(const Rig& rig, const SimulateOptions& options,
                                            std::span<const Direction> directions) {
  SensitivityResponse result;
  std::string reason = WhyInvalid(options);
  if (reason.empty()) reason = WhyInvalid(rig);
  if (reason.empty()) reason = WhyRefused(rig, directions);
  if (!reason.empty()) {
    result.response.status = SimulateStatus::kInvalid;
    result.response.detail = reason;
    return result;
  }
  const auto take = [&](const auto& dual, std::size_t count) {
    if (result.derivatives.empty() || dual.status != SimulateStatus::kDone) {
      result.response = Projection([](const auto& x) { return x.a; })(dual);
    }
    for (std::size_t j = 0; j < count; ++j) {
      result.derivatives.push_back(
          Projection([j](const auto& x) { return x.v[static_cast<Eigen::Index>(j)]; })(dual));
    }
  };
  ForEachChunk(rig, options, directions, take);
  for (std::size_t j = 0; j < result.derivatives.size(); ++j) {
    if (result.response.status != SimulateStatus::kDone || AllFinite(result.derivatives[j]))
      continue;
    result.response.status = SimulateStatus::kNotFinite;
    result.response.detail =
        "a derivative with respect to parameters[" + std::to_string(j) + "] is not finite";
  }
  return result;
}

}  // namespace plenum::model
