// Forces for several nodes of a row at a time, compiled for every SIMD target. No fused operations: every
// target gives the same bits.
#include "procedural/elasticity/grid_stiffness.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "procedural/elasticity/grid_stiffness.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lamella {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <typename Number>
using Tag = hn::CappedTag<Number, NodeGrid<3>::tile>;

/// Multiplies a row block of the element's stiffness with the displacements of an element's corners.
template <std::size_t Dim, typename Number, class V = hn::Vec<Tag<Number>>>
HWY_INLINE void AddElement(const ElementForces<Dim, Number>& elements, const Number* rows,
                           const std::array<const Number*, Dim>& u, std::size_t element, V* sums) {
    constexpr std::size_t corners = std::size_t{1} << Dim, unknowns = ElementForces<Dim, Number>::unknowns;
    const Tag<Number> d;
    V force[Dim];
    for (std::size_t i = 0; i < Dim; ++i) force[i] = hn::Zero(d);
    for (std::size_t c = 0; c < corners; ++c) {
        const auto node =
            static_cast<std::size_t>(static_cast<std::ptrdiff_t>(element) + elements.corners[c]);
        for (std::size_t j = 0; j < Dim; ++j) {
            const V along = hn::LoadU(d, u[j] + node);
            for (std::size_t i = 0; i < Dim; ++i)
                force[i] = hn::Add(force[i], hn::Mul(hn::Set(d, rows[i * unknowns + Dim * c + j]), along));
        }
    }
    const V modulus = hn::LoadU(d, elements.moduli + element);
    for (std::size_t i = 0; i < Dim; ++i) sums[i] = hn::Add(sums[i], hn::Mul(modulus, force[i]));
}

template <std::size_t Dim, typename Number>
void MultiplyElements(const ElementForces<Dim, Number>& elements, const std::array<const Number*, Dim>& u,
                      const std::array<Number*, Dim>& forces, std::size_t begin, std::size_t end) {
    constexpr std::size_t corners = std::size_t{1} << Dim, unknowns = ElementForces<Dim, Number>::unknowns;
    const Tag<Number> d;
    using V = hn::Vec<Tag<Number>>;
    for (std::size_t node = begin; node < end; node += hn::Lanes(d)) {
        V sums[Dim];
        for (std::size_t i = 0; i < Dim; ++i) sums[i] = hn::Zero(d);
        for (std::size_t c = 0; c < corners; ++c) {
            const auto element =
                static_cast<std::size_t>(static_cast<std::ptrdiff_t>(node) - elements.corners[c]);
            AddElement<Dim, Number>(elements, elements.stiffness.data() + Dim * c * unknowns, u, element,
                                    sums);
        }
        for (std::size_t i = 0; i < Dim; ++i) hn::StoreU(sums[i], d, forces[i] + (node - begin));
    }
}

template <std::size_t Dim>
void Energies(const ElementForces<Dim, double>& elements, const std::array<const double*, Dim>& u,
              double* energies, std::size_t begin, std::size_t end) {
    constexpr std::size_t corners = std::size_t{1} << Dim, unknowns = ElementForces<Dim, double>::unknowns;
    const Tag<double> d;
    using V = hn::Vec<Tag<double>>;
    for (std::size_t element = begin; element < end; element += hn::Lanes(d)) {
        V moved[unknowns];
        for (std::size_t c = 0; c < corners; ++c) {
            const auto node =
                static_cast<std::size_t>(static_cast<std::ptrdiff_t>(element) + elements.corners[c]);
            for (std::size_t j = 0; j < Dim; ++j) moved[Dim * c + j] = hn::LoadU(d, u[j] + node);
        }
        V energy = hn::Zero(d);
        for (std::size_t i = 0; i < unknowns; ++i) {
            V force = hn::Zero(d);
            for (std::size_t j = 0; j < unknowns; ++j)
                force = hn::Add(force, hn::Mul(hn::Set(d, elements.stiffness[i * unknowns + j]), moved[j]));
            energy = hn::Add(energy, hn::Mul(moved[i], force));
        }
        hn::StoreU(energy, d, energies + element);
    }
}

template <std::size_t Dim>
void MultiplyStencils(const StencilForces<Dim>& stencils, const std::array<const float*, Dim>& u,
                      const std::array<float*, Dim>& forces, std::size_t begin, std::size_t end) {
    constexpr std::size_t tile = NodeGrid<Dim>::tile;
    const Tag<float> d;
    using V = hn::Vec<Tag<float>>;
    for (std::size_t node = begin; node < end; node += hn::Lanes(d)) {
        const float* at =
            stencils.stencils + node / tile * (StencilForces<Dim>::entries * tile) + node % tile;
        V sums[Dim];
        for (std::size_t i = 0; i < Dim; ++i) sums[i] = hn::Zero(d);
        for (std::size_t k = 0; k < NodeGrid<Dim>::neighbours; ++k) {
            const auto other =
                static_cast<std::size_t>(static_cast<std::ptrdiff_t>(node) + stencils.neighbours[k]);
            V along[Dim];
            for (std::size_t j = 0; j < Dim; ++j) along[j] = hn::LoadU(d, u[j] + other);
            for (std::size_t i = 0; i < Dim; ++i) {
                for (std::size_t j = 0; j < Dim; ++j, at += tile)
                    sums[i] = hn::Add(sums[i], hn::Mul(hn::LoadU(d, at), along[j]));
            }
        }
        for (std::size_t i = 0; i < Dim; ++i) hn::StoreU(sums[i], d, forces[i] + (node - begin));
    }
}

// Templates cannot be exported to the dispatcher.
#define LAMELLA_ELEMENTS(NAME, DIM, NUMBER)                                                 \
    void NAME(const ElementForces<DIM, NUMBER>& e, const std::array<const NUMBER*, DIM>& u, \
              const std::array<NUMBER*, DIM>& f, std::size_t begin, std::size_t end) {      \
        MultiplyElements<DIM, NUMBER>(e, u, f, begin, end);                                 \
    }
LAMELLA_ELEMENTS(MultiplyPlaneFloat, 2, float)
LAMELLA_ELEMENTS(MultiplyPlaneDouble, 2, double)
LAMELLA_ELEMENTS(MultiplySolidFloat, 3, float)
LAMELLA_ELEMENTS(MultiplySolidDouble, 3, double)
#undef LAMELLA_ELEMENTS

void PlaneEnergies(const ElementForces<2, double>& e, const std::array<const double*, 2>& u, double* out,
                   std::size_t begin, std::size_t end) {
    Energies<2>(e, u, out, begin, end);
}
void SolidEnergies(const ElementForces<3, double>& e, const std::array<const double*, 3>& u, double* out,
                   std::size_t begin, std::size_t end) {
    Energies<3>(e, u, out, begin, end);
}
void PlaneStencils(const StencilForces<2>& s, const std::array<const float*, 2>& u,
                   const std::array<float*, 2>& f, std::size_t begin, std::size_t end) {
    MultiplyStencils<2>(s, u, f, begin, end);
}
void SolidStencils(const StencilForces<3>& s, const std::array<const float*, 3>& u,
                   const std::array<float*, 3>& f, std::size_t begin, std::size_t end) {
    MultiplyStencils<3>(s, u, f, begin, end);
}

}  // namespace HWY_NAMESPACE
}  // namespace lamella
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lamella {

HWY_EXPORT(MultiplyPlaneFloat);
HWY_EXPORT(MultiplyPlaneDouble);
HWY_EXPORT(MultiplySolidFloat);
HWY_EXPORT(MultiplySolidDouble);
HWY_EXPORT(PlaneEnergies);
HWY_EXPORT(SolidEnergies);
HWY_EXPORT(PlaneStencils);
HWY_EXPORT(SolidStencils);

template <>
void multiply(const ElementForces<2, float>& e, const std::array<const float*, 2>& u,
              const std::array<float*, 2>& f, std::size_t begin, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(MultiplyPlaneFloat)(e, u, f, begin, end);
}
template <>
void multiply(const ElementForces<2, double>& e, const std::array<const double*, 2>& u,
              const std::array<double*, 2>& f, std::size_t begin, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(MultiplyPlaneDouble)(e, u, f, begin, end);
}
template <>
void multiply(const ElementForces<3, float>& e, const std::array<const float*, 3>& u,
              const std::array<float*, 3>& f, std::size_t begin, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(MultiplySolidFloat)(e, u, f, begin, end);
}
template <>
void multiply(const ElementForces<3, double>& e, const std::array<const double*, 3>& u,
              const std::array<double*, 3>& f, std::size_t begin, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(MultiplySolidDouble)(e, u, f, begin, end);
}
template <>
void element_energies(const ElementForces<2, double>& e, const std::array<const double*, 2>& u,
                      double* energies, std::size_t begin, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(PlaneEnergies)(e, u, energies, begin, end);
}
template <>
void element_energies(const ElementForces<3, double>& e, const std::array<const double*, 3>& u,
                      double* energies, std::size_t begin, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(SolidEnergies)(e, u, energies, begin, end);
}
template <>
void multiply(const StencilForces<2>& s, const std::array<const float*, 2>& u, const std::array<float*, 2>& f,
              std::size_t begin, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(PlaneStencils)(s, u, f, begin, end);
}
template <>
void multiply(const StencilForces<3>& s, const std::array<const float*, 3>& u, const std::array<float*, 3>& f,
              std::size_t begin, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(SolidStencils)(s, u, f, begin, end);
}

}  // namespace lamella
#endif
