/// The passes that a render may be asked for beside combined, depth and normal.
#pragma once

#include <cstdint>

#include "base/config.h"

namespace trg {

/// Where the values of a pass come from.
enum class PassSource : int32_t {
    mean,    // of all samples, from a row of floats that each path fills
    centre,  // the ray through the pixel's centre
    matte,   // Cryptomatte: ids of the surfaces that camera rays meet, with their shares
    film     // the film itself knows
};

/// Order of kPassTable. The light of a kind of scattering lies three apart: direct, indirect,
/// colour; diffuse, glossy, transmission follow one another.
enum PassKind : int32_t {
    kDiffuseDirect,
    kDiffuseIndirect,
    kDiffuseColor,
    kGlossyDirect,
    kGlossyIndirect,
    kGlossyColor,
    kTransmissionDirect,
    kTransmissionIndirect,
    kTransmissionColor,
    kEmissionPass,
    kEnvironmentPass,
    kUvPass,
    kMistPass,
    kAmbientOcclusion,
    kDenoisingAlbedo,
    kDenoisingNormal,
    kMeanPasses,
    kPositionPass = kMeanPasses,
    kObjectIndex,
    kMaterialIndex,
    kObjectMatte,
    kMaterialMatte,
    kAssetMatte,
    kSampleCount,
    kPassKinds
};

struct PassInfo {
    const char* name;
    int32_t channels;  // 0: two a level of the mattes
    PassSource source;
};

constexpr PassInfo kPassTable[kPassKinds] = {{"diffuse_direct", 3, PassSource::mean},
                                             {"diffuse_indirect", 3, PassSource::mean},
                                             {"diffuse_color", 3, PassSource::mean},
                                             {"glossy_direct", 3, PassSource::mean},
                                             {"glossy_indirect", 3, PassSource::mean},
                                             {"glossy_color", 3, PassSource::mean},
                                             {"transmission_direct", 3, PassSource::mean},
                                             {"transmission_indirect", 3, PassSource::mean},
                                             {"transmission_color", 3, PassSource::mean},
                                             {"emission", 3, PassSource::mean},
                                             {"environment", 3, PassSource::mean},
                                             {"uv", 3, PassSource::mean},
                                             {"mist", 1, PassSource::mean},
                                             {"ambient_occlusion", 3, PassSource::mean},
                                             {"denoising_albedo", 3, PassSource::mean},
                                             {"denoising_normal", 3, PassSource::mean},
                                             {"position", 3, PassSource::centre},
                                             {"object_index", 1, PassSource::centre},
                                             {"material_index", 1, PassSource::centre},
                                             {"cryptomatte_object", 0, PassSource::matte},
                                             {"cryptomatte_material", 0, PassSource::matte},
                                             {"cryptomatte_asset", 0, PassSource::matte},
                                             {"sample_count", 1, PassSource::film}};

/// Where the passes lie in the rows of paths; -1 where nobody asked.
struct PassLayout {
    int32_t at[kMeanPasses];
    int32_t stride;  // floats a path
    bool lights;     // any light of diffuse, glossy, transmission
    bool colors;     // any colour or denoising feature
    bool features;   // any denoising feature
    bool mattes;
};

/// What the passes need to know of the scene; ids are by instance and by material.
struct PassView {
    PassLayout layout;
    const float* instance_ids;  // three each: index, object matte, asset matte; or null
    const float* material_ids;  // two each: index, matte; or null
    float mist_start, mist_depth, mist_falloff;
    float ambient_distance;
};

}  // namespace trg
