#include "model/physics/chamber.h"

#include <cmath>
#include <sstream>

namespace plenum::model {
namespace {

std::string Reason(const char* field, double value, const char* range) {
  std::ostringstream text;
  text << field << " is " << value << ", must be " << range;
  return text.str();
}

// dV/dp of the linear law.
double LinearSlope(const Chamber& chamber) {
  return chamber.rest_volume_m3 * (chamber.expansion_ratio - 1.0) /
         (chamber.operating_pressure_pa - chamber.ambient_pressure_pa);
}

std::string WhyCurveInvalid(const Chamber& chamber) {
  const auto p = chamber.volume_curve.x();
  const auto v = chamber.volume_curve.y();
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!std::isfinite(p[i])) return Reason("volume_curve pressure", p[i], "finite");
    if (!(v[i] > 0.0) || !std::isfinite(v[i])) {
      return Reason("volume_curve volume", v[i], "positive and finite");
    }
    if (i == 0) continue;
    if (!(p[i] > p[i - 1])) return Reason("volume_curve pressure", p[i], "above the one before it");
    if (v[i] < v[i - 1]) return Reason("volume_curve volume", v[i], "no less than the one before");
  }
  if (p.front() > chamber.ambient_pressure_pa) {
    return Reason("first pressure of volume_curve", p.front(), "at or below ambient_pressure_pa");
  }
  if (p.back() < chamber.operating_pressure_pa) {
    return Reason("last pressure of volume_curve", p.back(), "at or above operating_pressure_pa");
  }
  return {};
}

// Of what is pulled below ambient.
std::string WhyLowInvalid(const Chamber& chamber) {
  const double low_pa = chamber.low_pressure_pa, exhaust_pa = chamber.exhaust_pressure_pa;
  if (!(low_pa >= 0.0 && low_pa <= chamber.ambient_pressure_pa))
    return Reason("low_pressure_pa", low_pa, "0 or above it and at most ambient_pressure_pa");
  if (!(exhaust_pa >= 0.0) || !std::isfinite(exhaust_pa))
    return Reason("exhaust_pressure_pa", exhaust_pa, "finite and at least 0");
  if (chamber.evacuated && (low_pa > 0.0 || exhaust_pa > 0.0))
    return "low_pressure_pa and exhaust_pressure_pa are for actuators under pressure, not "
           "evacuated ones";
  if (low_pa > 0.0 && !(Volume(chamber, low_pa) > chamber.dead_volume_m3))
    return Reason("low_pressure_pa", low_pa, "where the law of the volume leaves some");
  return {};
}

}  // namespace

std::string WhyInvalid(const Chamber& chamber) {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (!positive(chamber.ambient_pressure_pa)) {
    return Reason("ambient_pressure_pa", chamber.ambient_pressure_pa, "positive and finite");
  }
  const bool shrinks = Shrinks(chamber);
  const bool apart = shrinks ? chamber.operating_pressure_pa > 0.0
                             : chamber.operating_pressure_pa > chamber.ambient_pressure_pa;
  if (!apart || !std::isfinite(chamber.operating_pressure_pa)) {
    return Reason("operating_pressure_pa", chamber.operating_pressure_pa,
                  "finite and above ambient_pressure_pa, or between 0 and it where the actuator "
                  "shrinks");
  }
  if (!(chamber.dead_volume_m3 >= 0.0) || !std::isfinite(chamber.dead_volume_m3)) {
    return Reason("dead_volume_m3", chamber.dead_volume_m3, "finite and at least 0");
  }
  if ((chamber.evacuated || shrinks) && !chamber.volume_curve.empty())
    return "volume_curve is for actuators under pressure, not evacuated ones";
  if (chamber.evacuated && !(chamber.operating_pressure_pa < MirrorPa(chamber)))
    return Reason("operating_pressure_pa (mirrored)", chamber.operating_pressure_pa,
                  "below twice ambient_pressure_pa");
  if (!chamber.volume_curve.empty()) {
    std::string why = WhyCurveInvalid(chamber);
    return why.empty() ? WhyLowInvalid(chamber) : why;
  }
  if (!positive(chamber.rest_volume_m3)) {
    return Reason("rest_volume_m3", chamber.rest_volume_m3, "positive and finite");
  }
  const bool below = chamber.evacuated || shrinks;
  if (below && !(chamber.expansion_ratio > 0.0 && chamber.expansion_ratio <= 1.0)) {
    return Reason("expansion_ratio", chamber.expansion_ratio, "above 0 and at most 1");
  }
  if (!below && (!(chamber.expansion_ratio >= 1.0) || !std::isfinite(chamber.expansion_ratio))) {
    return Reason("expansion_ratio", chamber.expansion_ratio, "finite and at least 1");
  }
  return WhyLowInvalid(chamber);
}

double Volume(const Chamber& chamber, double pressure_pa) {
  if (!chamber.volume_curve.empty()) {
    return chamber.dead_volume_m3 + chamber.volume_curve(pressure_pa);
  }
  return chamber.dead_volume_m3 + chamber.rest_volume_m3 +
         LinearSlope(chamber) * (pressure_pa - chamber.ambient_pressure_pa);
}

double VolumeSlope(const Chamber& chamber, double pressure_pa) {
  return chamber.volume_curve.empty() ? LinearSlope(chamber)
                                      : chamber.volume_curve.Slope(pressure_pa);
}

Chamber Unmirrored(Chamber chamber) {
  if (!chamber.evacuated) return chamber;
  chamber.operating_pressure_pa = MirrorPa(chamber) - chamber.operating_pressure_pa;
  chamber.evacuated = false;
  return chamber;
}

double Content(const Chamber& chamber, double pressure_pa) {
  return (pressure_pa - MirrorPa(chamber)) * Volume(chamber, pressure_pa);
}

double ContentSlope(const Chamber& chamber, double pressure_pa) {
  return Volume(chamber, pressure_pa) +
         (pressure_pa - MirrorPa(chamber)) * VolumeSlope(chamber, pressure_pa);
}

LinearContent LinearContentSlope(const Chamber& chamber) {
  const double slope = LinearSlope(chamber);
  return {Volume(chamber, 0.0) - slope * MirrorPa(chamber), 2.0 * slope};
}

}  // namespace plenum::model
