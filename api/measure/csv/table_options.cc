#include "api/measure/csv/table_options.h"

#include "api/json/words.h"
#include "api/measure/csv/recording_layout.h"
#include "catalog/fields/csv_table.h"
#include "catalog/tables/encoding.h"

namespace plenum::api {

void ReadTableOptions(Reader& reader, catalog::TableOptions& options) {
  const auto take = [&](const char* name, const std::vector<std::string>& allowed,
                        std::string& option) {
    const std::string given = reader.Choice(name, allowed, "");
    if (option.empty()) option = given;
  };
  take("encoding", catalog::EncodingNames(), options.encoding);
  take("delimiter", RecordingDelimiters(), options.delimiter);
  take("decimal", {"point", "comma"}, options.decimal);
  const int row = reader.Integer("header_row", 0, 1'000'000, 0);
  if (options.header_row == 0) options.header_row = row;
  if (auto columns = reader.OptionalObject("columns")) {
    std::size_t count = 0;
    for (const std::string& heading : columns->Names()) {
      if (++count > catalog::kCsvColumnsMax) break;
      const Json* target = columns->Raw(heading);
      if (target != nullptr && target->is_string() &&
          target->get_ref<const std::string&>().size() <= 500)
        options.columns.try_emplace(heading, target->get<std::string>());
      else
        columns->Fail(heading,
                      "must be a text of at most 500 bytes, as \"pressure_kpa_gauge [bar]\"");
    }
    columns->Finish();
  }
  reader.Finish();
}

}  // namespace plenum::api
