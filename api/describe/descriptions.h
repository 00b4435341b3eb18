// JSON Schemas (2020-12) of the documents that requests hold, made of what validates them: the
// readers, the families of parts, the registry of effects.
#ifndef PLENUM_API_DESCRIBE_DESCRIPTIONS_H_
#define PLENUM_API_DESCRIBE_DESCRIPTIONS_H_

#include "api/json/json.h"
#include "api/measure/csv/recording_request.h"  // with the schema of recordings

namespace plenum::api {

Json DescribeRequirements();  // requirements/1
Json DescribeMeasurement();   // measurement/1, with the service's own fields "model" and "save"
Json DescribeSimulation();    // simulation/1
Json DescribeMap();           // map/1
Json DescribeModel();         // model/1
Json DescribeGivenDesign();   // "design" of evaluation/1
Json DescribePart();

// Documents that are valid with the catalogue that comes with plenum, the first ones short.
Json ExampleRequirements();
Json ExampleMeasurement();
Json ExampleSimulation();
Json ExampleMap();
Json ExampleEvaluation();
Json ExampleModel();
Json ExamplePart();

}  // namespace plenum::api

#endif  // PLENUM_API_DESCRIBE_DESCRIPTIONS_H_
