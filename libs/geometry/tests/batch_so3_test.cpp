// Batches of SO3 in every variant, number and place.
#include "batch_places.h"

namespace batch_places {

INSTANTIATE_TYPED_TEST_SUITE_P(SO3d, Batch, Operations<SO3<double>>, );
INSTANTIATE_TYPED_TEST_SUITE_P(SO3f, Batch, Operations<SO3<float>>, );

}  // namespace batch_places
