// Batches of SE3 in every variant, number and place.
#include "batch_places.h"

namespace batch_places {

INSTANTIATE_TYPED_TEST_SUITE_P(SE3d, Batch, Operations<SE3<double>>, );
INSTANTIATE_TYPED_TEST_SUITE_P(SE3f, Batch, Operations<SE3<float>>, );

}  // namespace batch_places
