// Tests of parts as JSON text: how they are measured, and what was measured as a revision. All
// throw Refused or catalog::StoreError.
#ifndef PLENUM_PYTHON_CORE_MEASURED_PARTS_H_
#define PLENUM_PYTHON_CORE_MEASURED_PARTS_H_

#include <map>
#include <string>
#include <vector>

namespace plenum::python {

// protocol/1 of a part. `sensor`: as the query parameters of the service
// (api/protocol/test_sensor).
std::string Protocol(const std::string& path, const std::string& id,
                     const std::multimap<std::string, std::string>& sensor);

// How a revision with measured numbers is written: by whom, of which piece of the type ("": without
// a name), and whether numbers that contradict what is known are written, too.
struct MeasuredBy {
  std::string who, specimen;
  bool anyway = false;
};
// The numbers that a diagnosis/1 found of the part; gives its `saved_part`.
std::string SavePart(const std::string& path, const std::string& id, const std::string& diagnosis,
                     const MeasuredBy& by);
// Numbers read by hand (api/protocol/read_by_hand.h): "mass_kg=25.3 g"; gives the same.
std::string WriteMeasured(const std::string& path, const std::string& id,
                          const std::vector<std::string>& readings, const std::string& uncertainty,
                          const std::string& note, const MeasuredBy& by);

}  // namespace plenum::python

#endif  // PLENUM_PYTHON_CORE_MEASURED_PARTS_H_
