// The kernels of score_kernels.cpp for one target region; included once for each, so without an
// include guard, with GSLAM_SCORE_VARIANT the name of a namespace and GSLAM_SCORE_WIDTH the floats
// of a register.
namespace gslam {
inline namespace v1 {
namespace detail {
namespace {
namespace GSLAM_SCORE_VARIANT {

typedef float Register __attribute__((vector_size(4 * GSLAM_SCORE_WIDTH)));
typedef int Mask __attribute__((vector_size(4 * GSLAM_SCORE_WIDTH)));

enum : std::size_t { kRegisters = kLanes / GSLAM_SCORE_WIDTH };

// Handed on by reference, since registers that a caller may not have cannot be returned.
inline void load(const float* from, Register& values) {
  std::memcpy(&values, from, sizeof(values));
}

// Calls add(register, its number) for all values; the last ones are padded with the filler.
template <class Add>
inline void forRegisters(const float* squared, std::size_t count, float filler, const Add& add) {
  float padded[kLanes];
  Register values;
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (std::size_t k = 0; k < kRegisters; ++k) {
      load(squared + i + k * GSLAM_SCORE_WIDTH, values);
      add(values, k);
    }
  }
  if (i == count) return;
  for (std::size_t k = 0; k < kLanes; ++k) padded[k] = i + k < count ? squared[i + k] : filler;
  for (std::size_t k = 0; k < kRegisters; ++k) {
    load(padded + k * GSLAM_SCORE_WIDTH, values);
    add(values, k);
  }
}

inline double total(const Register* sums) {
  float parts[kLanes];
  std::memcpy(parts, sums, sizeof(parts));
  return totalOfLanes(parts);
}

struct AddTruncated {
  const Register& limits;
  Register* sums;
  void operator()(const Register& squared, std::size_t k) const {
    sums[k] += squared < limits ? squared : limits;  // NaN: the limit
  }
};

struct AddBelow {
  const Register& limits;
  Mask* sums;
  void operator()(const Register& squared, std::size_t k) const {
    sums[k] += squared <= limits;  // true is -1
  }
};

struct AddMagsac {
  const Register& limits;
  float factor;
  Register* sums;
  void operator()(const Register& squared, std::size_t k) const {
    const Register u = (squared < limits ? squared : limits) * factor;
    Register power;
    expMinus(u, power);
    sums[k] += (1.0f - power - u * kMagsacFloor) * kMagsacScale;
  }
};

inline double truncated(const float* squared, std::size_t count, float limit) {
  const Register limits = Register{} + limit;
  Register sums[kRegisters] = {};
  forRegisters(squared, count, 0, AddTruncated{limits, sums});
  return total(sums);
}

inline double above(const float* squared, std::size_t count, float limit) {
  const Register limits = Register{} + limit;
  Mask sums[kRegisters] = {};
  forRegisters(squared, count, std::numeric_limits<float>::infinity(), AddBelow{limits, sums});
  int parts[kLanes], below = 0;
  std::memcpy(parts, sums, sizeof(parts));
  for (const int part : parts) below -= part;
  return static_cast<double>(count) - below;
}

inline double magsac(const float* squared, std::size_t count, float limit) {
  const Register limits = Register{} + limit;
  Register sums[kRegisters] = {};
  forRegisters(squared, count, 0, AddMagsac{limits, kMagsacEnd / limit, sums});
  return total(sums);
}

}  // namespace GSLAM_SCORE_VARIANT
}  // namespace
}  // namespace detail
}  // namespace v1
}  // namespace gslam
