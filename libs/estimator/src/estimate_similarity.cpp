#include <gslam/estimator/estimate_rigid_3d.h>
#include <gslam/estimator/estimate_similarity_3d.h>

#include <utility>

#include "robust/affine_problem.h"
#include "robust/estimate_points.h"

namespace gslam {
inline namespace v1 {
namespace {

template <class Group, std::size_t Dof>
bool search(Span<const Vec3d> first, Span<const Vec3d> second, const EstimateOptions& options,
            Estimate<Group, Dof>& result, SIM3d& model) {
  if (!detail::checkPairs(first, second, 3, 0, options, result)) return false;
  const Degeneracy shape = detail::shapeOfAll(first);
  if (shape == Degeneracy::Collinear || shape == Degeneracy::Coincident) {
    return detail::refuseShape("first", shape, result);
  }
  const detail::RandomOrder order = detail::randomOrder(first.size(), options.seed);
  const bool is_rigid = Dof == 6;
  const detail::SimilarityProblem problem(first, second, order, is_rigid);
  detail::LoopResult found = detail::runRobustLoop(problem, options, result.threshold, order);
  static_cast<EstimateSummary&>(result) = std::move(found.summary);
  if (!found.has_model) return false;
  model = problem.similarityOf(found.model);
  // Inside, the first points are about their centre c: exp(delta) = T(c) exp(inner delta) T(-c).
  const Group to_centre(SE3d(SO3d(), problem.firstCentre()));
  result.covariance = detail::mappedCovariance(to_centre.adjoint(), found.covariance);
  return true;
}

}  // namespace

Rigid3DEstimate estimateRigid3D(Span<const Vec3d> first, Span<const Vec3d> second,
                                const EstimateOptions& options) {
  Rigid3DEstimate result;
  SIM3d model;
  if (search(first, second, options, result, model)) {
    result.model = SE3d(model.rotation(), model.translation());
  }
  return result;
}

Similarity3DEstimate estimateSimilarity3D(Span<const Vec3d> first, Span<const Vec3d> second,
                                          const EstimateOptions& options) {
  Similarity3DEstimate result;
  SIM3d model;
  if (search(first, second, options, result, model)) result.model = model;
  return result;
}

}  // namespace v1
}  // namespace gslam
