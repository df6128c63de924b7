// Batches of SIM3 in every variant, number and place.
#include "batch_places.h"

namespace batch_places {

INSTANTIATE_TYPED_TEST_SUITE_P(SIM3d, Batch, Operations<SIM3<double>>, );
INSTANTIATE_TYPED_TEST_SUITE_P(SIM3f, Batch, Operations<SIM3<float>>, );

}  // namespace batch_places
