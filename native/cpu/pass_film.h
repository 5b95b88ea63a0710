/// Sums of the passes that were asked for, pixel by pixel.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kernel/path_queues.h"

namespace trg {

/// Which passes a render keeps.
struct PassRequest {
    uint32_t asked = 0;  // a bit for each PassKind
    int32_t matte_levels = 6;

    bool has(PassKind kind) const { return (asked >> kind & 1u) != 0; }
    /// Whether any pass needs more of the kernels than combined does.
    bool needs_kernels() const;
    bool needs_centre() const;
};

/// The pass called `name`; kPassKinds for none.
PassKind find_pass(const std::string& name);

/// Where the passes lie in the rows of paths. Lights bring the colours that they are divided by.
PassLayout lay_out_passes(const PassRequest& request);

/// What the ray through a pixel's centre meets.
struct PixelCentre {
    Vec3 position;
    float object_index, material_index;
};

class PassFilm {
  public:
    PassFilm(const PassRequest& request, int64_t pixels);

    const PassRequest& request() const { return request_; }
    const PassLayout& layout() const { return layout_; }
    /// Adds what path number `path` left to `pixel`. What is not finite counts as 0.
    void add(int64_t pixel, const PassView& view, const PassQueues& passes, int32_t path);
    void set_centre(int64_t pixel, const PixelCentre& centre);
    int32_t channels(PassKind kind) const;
    /// The value of `pixel`, which has `samples` samples, into `out`.
    void read(PassKind kind, int64_t pixel, double samples, float* out) const;

  private:
    struct Matte {
        float id, weight;
    };
    const Matte* mattes_at(PassKind kind, int64_t pixel) const;
    void add_mattes(int64_t pixel, const PassView& view, const PassHit& hit);
    void read_light(PassKind kind, const double* row, float* out) const;
    void read_matte(PassKind kind, int64_t pixel, double samples, float* out) const;

    PassRequest request_;
    PassLayout layout_;
    int32_t matte_kinds_ = 0;
    std::vector<double> sums_;
    std::vector<PixelCentre> centres_;
    std::vector<Matte> mattes_;
};

}  // namespace trg
