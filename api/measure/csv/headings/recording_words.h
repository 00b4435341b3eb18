// The words that headings of recordings are made of, English and German.
#ifndef PLENUM_API_MEASURE_CSV_HEADINGS_RECORDING_WORDS_H_
#define PLENUM_API_MEASURE_CSV_HEADINGS_RECORDING_WORDS_H_

#include <string>
#include <string_view>
#include <vector>

namespace plenum::api {

// Fields of a recording: columns of the documented CSV, two valves instead of one, and a date
// beside a clock.
inline constexpr std::string_view kRunField = "run", kSpecimenField = "specimen",
                                  kDateField = "date", kTimeField = "t_s", kValveField = "valve",
                                  kInflateValveField = "inflate_valve",
                                  kDeflateValveField = "deflate_valve",
                                  kPressureField = "pressure_kpa_gauge",
                                  kSourcePressureField = "source_pressure_kpa_gauge",
                                  kInletPressureField = "inlet_pressure_kpa_gauge",
                                  kTemperatureField = "temperature_k", kVolumeField = "volume_ml",
                                  kFlowField = "flow_l_per_min_anr",
                                  kOpeningField = "valve_opening",
                                  kSetpointField = "source_setpoint_kpa_gauge";
const std::vector<std::string>& RecordingFields();
bool IsValveField(std::string_view field);
bool IsPressureField(std::string_view field);
// With readings: pressures, temperature, volume, flow, opening.
bool IsReadingField(std::string_view field);

// The fields that the words of a heading, without its unit, may name: "Supply Druck" the source
// pressure, "T" time or temperature. None: not known, or words that contradict each other.
std::vector<std::string_view> FieldsNamed(std::string_view words);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CSV_HEADINGS_RECORDING_WORDS_H_
