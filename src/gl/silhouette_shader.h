#pragma once

namespace gnomon {

/// The geometry shader of AtomicZP (Usta et al. 2019, section 3): extrudes the silhouettes of a
/// SilhouetteMesh to infinity, draws their sides in front of the eye and the far caps, and counts the lit
/// triangles between the eye and the light in an atomic counter.
///
/// It repeats cutVolume() in the same arithmetic (double precision, rounded once), so that both draw the same
/// vertices to the bit, and no pixel differs between this and the methods whose volumes the host builds.
extern const char* const kSilhouetteVertex;
extern const char* const kSilhouetteGeometry;

}  // namespace gnomon
