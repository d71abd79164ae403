#include <cmath>
#include <cstdio>

#include "command.h"

namespace pelage {

void print_json(const Json& json) { std::puts(json.dump(2, ' ', false, Json::error_handler_t::replace).c_str()); }

Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_number(const std::optional<double>& value) { return value ? json_number(*value) : Json(nullptr); }

Json json_findings(const std::vector<Finding>& findings) {
  Json list = Json::array();
  for (const Finding& f : findings)
    list.push_back(
        {{"kind", f.kind}, {"text", f.text}, {"count", f.count}, {"first", f.element}, {"repaired", f.repaired}});
  return list;
}

}  // namespace pelage
