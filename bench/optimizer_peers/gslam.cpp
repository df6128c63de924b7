// Our own back end.
#include <gslam/optimizer_pba.h>

#include "facade_rows.h"

namespace {

struct Pba {
  static constexpr const char* text = "pba";
};
const bool kRows = FacadeRows<Pba>::add("gslam", true);

}  // namespace
