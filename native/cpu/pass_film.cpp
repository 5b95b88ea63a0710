#include "cpu/pass_film.h"

#include <algorithm>
#include <cmath>

namespace trg {

namespace {

bool is_light(PassKind kind) {
    return kind <= kTransmissionColor && kind % 3 != 2;
}

/// The colour by which a light is divided.
PassKind color_of(PassKind light) {
    return static_cast<PassKind>(light / 3 * 3 + 2);
}

}  // namespace

PassKind find_pass(const std::string& name) {
    for (int kind = 0; kind < kPassKinds; ++kind)
        if (name == kPassTable[kind].name) return static_cast<PassKind>(kind);
    return kPassKinds;
}

bool PassRequest::needs_kernels() const {
    for (int kind = 0; kind < kPassKinds; ++kind)
        if (has(static_cast<PassKind>(kind)) && (kPassTable[kind].source == PassSource::mean ||
                                                 kPassTable[kind].source == PassSource::matte))
            return true;
    return false;
}

bool PassRequest::needs_centre() const {
    return has(kPositionPass) || has(kObjectIndex) || has(kMaterialIndex);
}

PassLayout lay_out_passes(const PassRequest& request) {
    PassLayout layout{};
    bool wanted[kMeanPasses];
    for (int k = 0; k < kMeanPasses; ++k) wanted[k] = request.has(static_cast<PassKind>(k));
    for (int k = 0; k <= kTransmissionColor; ++k) {
        const PassKind kind = static_cast<PassKind>(k);
        if (!request.has(kind) || !is_light(kind)) continue;
        wanted[color_of(kind)] = layout.lights = true;
    }
    for (int k = 0; k < kMeanPasses; ++k) {
        layout.at[k] = wanted[k] ? layout.stride : -1;
        if (wanted[k]) layout.stride += kPassTable[k].channels;
    }
    layout.features = wanted[kDenoisingAlbedo] || wanted[kDenoisingNormal];
    layout.colors = layout.features || wanted[kDiffuseColor] || wanted[kGlossyColor] ||
                    wanted[kTransmissionColor];
    layout.mattes =
        request.has(kObjectMatte) || request.has(kMaterialMatte) || request.has(kAssetMatte);
    return layout;
}

PassFilm::PassFilm(const PassRequest& request, int64_t pixels)
    : request_(request), layout_(lay_out_passes(request)) {
    for (int kind = kObjectMatte; kind <= kAssetMatte; ++kind)
        matte_kinds_ += request.has(static_cast<PassKind>(kind)) ? 1 : 0;
    sums_.resize(static_cast<size_t>(pixels) * layout_.stride);
    if (request.needs_centre()) centres_.resize(pixels, {{0.0f, 0.0f, 0.0f}, 0.0f, 0.0f});
    mattes_.resize(static_cast<size_t>(pixels) * matte_kinds_ * request.matte_levels, {0.0f, 0.0f});
}

void PassFilm::add(int64_t pixel, const PassView& view, const PassQueues& passes, int32_t path) {
    const float* row = passes.values + static_cast<int64_t>(path) * layout_.stride;
    double* sum = sums_.data() + pixel * layout_.stride;
    for (int32_t k = 0; k < layout_.stride; ++k)
        if (std::isfinite(row[k])) sum[k] += row[k];
    if (layout_.mattes && passes.hits[path].instance >= 0)
        add_mattes(pixel, view, passes.hits[path]);
}

const PassFilm::Matte* PassFilm::mattes_at(PassKind kind, int64_t pixel) const {
    int32_t before = 0;
    for (int k = kObjectMatte; k < kind; ++k)
        before += request_.has(static_cast<PassKind>(k)) ? 1 : 0;
    return mattes_.data() + (pixel * matte_kinds_ + before) * request_.matte_levels;
}

/// An id takes the first free place; where there is none left, the last one counts it.
void PassFilm::add_mattes(int64_t pixel, const PassView& view, const PassHit& hit) {
    const float* instance = view.instance_ids ? view.instance_ids + 3 * hit.instance : nullptr;
    const float* material = view.material_ids ? view.material_ids + 2 * hit.material : nullptr;
    const float ids[3] = {instance ? instance[1] : 0.0f, material ? material[1] : 0.0f,
                          instance ? instance[2] : 0.0f};
    for (int k = 0; k < 3; ++k) {
        const PassKind kind = static_cast<PassKind>(kObjectMatte + k);
        if (!request_.has(kind) || ids[k] == 0.0f) continue;
        Matte* place = const_cast<Matte*>(mattes_at(kind, pixel));
        const Matte* last = place + request_.matte_levels - 1;
        while (place < last && place->id != ids[k] && place->weight > 0.0f) ++place;
        if (place->weight == 0.0f) place->id = ids[k];
        place->weight += 1.0f;
    }
}

void PassFilm::set_centre(int64_t pixel, const PixelCentre& centre) {
    centres_[pixel] = centre;
}

int32_t PassFilm::channels(PassKind kind) const {
    return kPassTable[kind].channels > 0 ? kPassTable[kind].channels : 2 * request_.matte_levels;
}

/// Light over colour; a channel without colour gets the mean of the others, as in Cycles.
void PassFilm::read_light(PassKind kind, const double* row, float* out) const {
    const double* light = row + layout_.at[kind];
    const double* color = row + layout_.at[color_of(kind)];
    double total = 0.0;
    int coloured = 0;
    for (int c = 0; c < 3; ++c) {
        out[c] = color[c] > 0.0 ? static_cast<float>(light[c] / color[c]) : 0.0f;
        total += out[c];
        coloured += color[c] > 0.0 ? 1 : 0;
    }
    for (int c = 0; c < 3; ++c)
        if (coloured > 0 && !(color[c] > 0.0)) out[c] = static_cast<float>(total / coloured);
}

/// Pairs of id and share, the largest first; of equal shares the one met first.
void PassFilm::read_matte(PassKind kind, int64_t pixel, double samples, float* out) const {
    std::vector<Matte> sorted(mattes_at(kind, pixel),
                              mattes_at(kind, pixel) + request_.matte_levels);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Matte& a, const Matte& b) { return a.weight > b.weight; });
    for (int32_t level = 0; level < request_.matte_levels; ++level) {
        out[2 * level] = sorted[level].id;
        out[2 * level + 1] =
            samples > 0.0 ? static_cast<float>(sorted[level].weight / samples) : 0.0f;
    }
}

void PassFilm::read(PassKind kind, int64_t pixel, double samples, float* out) const {
    if (kind == kSampleCount) {
        *out = static_cast<float>(samples);
    } else if (kPassTable[kind].source == PassSource::matte) {
        read_matte(kind, pixel, samples, out);
    } else if (kind == kPositionPass) {
        const Vec3 p = centres_[pixel].position;
        out[0] = p.x;
        out[1] = p.y;
        out[2] = p.z;
    } else if (kind == kObjectIndex || kind == kMaterialIndex) {
        *out = kind == kObjectIndex ? centres_[pixel].object_index : centres_[pixel].material_index;
    } else {
        const double* row = sums_.data() + pixel * layout_.stride;
        if (is_light(kind)) return read_light(kind, row, out);
        for (int32_t c = 0; c < kPassTable[kind].channels; ++c)
            out[c] = samples > 0.0 ? static_cast<float>(row[layout_.at[kind] + c] / samples) : 0.0f;
    }
}

}  // namespace trg
