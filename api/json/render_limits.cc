#include "api/json/render_limits.h"

#include "api/json/request_limits.h"

namespace plenum::api {

Json RenderRequestLimits() {
  return {{"json_depth_max", kJsonDepthMax},
          {"json_memory_bytes_max", kJsonBytesMax},
          {"errors_reported_max", kErrorsReportedMax},
          {"text_characters_max", kTextCharactersMax},
          {"groups_max", kGroupsMax},
          {"valve_commands_max", kCommandsMax},
          {"effects_max", kEffectsMax},
          {"curve_points_max", kTablePointsMax},
          {"simulation_samples_max", kSimulationSamplesMax},
          {"simulation_seconds_max", kSimulationSecondsMax},
          {"evaluation_seconds_max", kEvaluationSecondsMax},
          {"map_axis_max", kMapAxisMax},
          {"map_points_max", kMapPointsMax},
          {"map_points_with_compressor_max", kMapPointsCompressorMax},
          {"map_seconds_max", kMapSecondsMax},
          {"measurement_runs_max", kRunsMax},
          {"measurement_samples_max", kRunSamplesMax},
          {"designs_max", kDesignsMax},
          {"design_seconds_max", kDesignSecondsMax},
          {"diagnosis_seconds_max", kDiagnosisSecondsMax},
          {"excluded_parts_max", kExcludedMax},
          {"page_parts_max", kPageMax},
          {"sweep_patches_max", kSweepPatchesMax},
          {"sweep_bytes_max", kSweepBytesMax}};
}

}  // namespace plenum::api
