"""Nacreous lookup textures as a BSDF of Mitsuba 3: thin-film interference, smooth and rough.

    import mitsuba as mi
    import nacreous_bsdf

    mi.set_variant("llvm_ad_spectral")
    nacreous_bsdf.register()  # once for each variant
    bsdf = mi.load_dict({"type": "nacreous", "filename": "film.spectral.exr", "alpha": 0.1})

==========================  ================================================================================
``filename``                a table of R: ``film.exr`` in RGB variants, ``film.spectral.exr`` in spectral ones
``thickness_scale``         float or texture: the row of the table, what multiplies all thicknesses (1)
``alpha``                   float or texture: roughness of the facets; 0 or absent is a smooth surface
``alpha_u``, ``alpha_v``    the same along the two tangents, instead of ``alpha``
``distribution``            of the facets' normals, ``ggx`` (default) or ``beckmann``
``int_ior``, ``ext_ior``    indices of substrate and incident medium, to refract; from the file if constant
``specular_reflectance``    spectrum or texture: multiplies R, without physics (1)
``specular_transmittance``  the same for T
==========================  ================================================================================

**The law.** A table holds R(cos θ, thickness scale), the share of the incident flux that the film reflects;
``film.transmission.exr`` or ``film.transmission.spectral.exr``, if it lies beside it, holds T, the share that
enters the substrate. The facets' normals m have the density D(m) and shadow each other by G. R and T are
those at the facet: cos θ = abs(ω · m), of the direction ω in the incident medium. Walter et al. 2007,
equations 20 and 21, are one formula, with F for R or T and η = n_o / n_i, or 1 for reflection:

    f(ω_i, ω_o) |cos θ_o| = F D(m) G(ω_i, ω_o, m) |ω_i · m| J / |cos θ_i|        m ∝ ω_i + η ω_o
    J = dω_m / dω_o = η² |ω_o · m| / (ω_i · m + η ω_o · m)²

T already holds the refracted beam's cross-section and index: R + T = 1 without absorption. Radiance changes
with the solid angle it fills: under ``TransportMode.Radiance``, Mitsuba's default, f_t is divided by η², as
in Mitsuba's own dielectrics; under ``Importance`` it counts the flux, as the table does.

**Sampling.** Visible normals (Heitz and D'Eon 2014), then reflection with the probability |R| / (|R| + |T|)
at that facet. The bars are means over the channels, of magnitudes: a colour outside of the gamut has a
negative channel.

**Sides.** Without a file of T the surface is opaque and one-sided, as Mitsuba's conductors are: put it into
``twosided`` to see it from behind. With one, light out of the substrate meets T of the same path, which is
exact (reciprocity), and R of the same path: exact for films without absorption, where it is 1 - T. Of others
the table does not hold it, and R is an assumption that never makes energy. Beyond the critical angle R is 1.

**Limits.** Unpolarised: for Mueller matrices Nacreous writes ``.pbsdf``, which ``measured_polarized`` reads.
One index for refraction at all wavelengths. Light that facets scatter more than once is lost, as in Mitsuba's
own rough surfaces. Wavelengths beyond the table's take the values at its ends.

Tested with Mitsuba 3.9. Imports nothing of Nacreous.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import drjit as dr
import mitsuba as mi
import numpy as np
from nacreous_lookup import LookupFile, read_table

__all__ = ["register"]

CONSTANT_INDEX = {"vacuum": 1.0, "air": 1.000277}
"""The media that a spec may name and that have one index: as Nacreous's library has them."""


def register(name: str = "nacreous") -> None:
    """Make the plugin known to the current variant; raises `ValueError` where that cannot hold the table."""
    if mi.is_polarized or not (mi.is_rgb or mi.is_spectral):
        raise ValueError(
            f"expected an unpolarised RGB or spectral variant, got {mi.variant()}; "
            "for polarised light write a .pbsdf and use Mitsuba's measured_polarized"
        )
    mi.register_bsdf(name, _plugin())


def _plugin() -> type:
    """Return what Mitsuba instantiates: its base class is another one in each variant."""

    class NacreousBSDF(mi.BSDF):
        def __init__(self, props: mi.Properties) -> None:
            mi.BSDF.__init__(self, props)
            self.surface = _surface(props)
            self.m_components = self.surface.film.components()
            self.m_flags = np.bitwise_or.reduce(self.m_components).item()

        def sample(self, *args: object, **kwargs: object) -> tuple[mi.BSDFSample3f, mi.Spectrum]:
            return self.surface.sample(*args, **kwargs)

        def eval_pdf(self, *args: object, **kwargs: object) -> tuple[mi.Spectrum, mi.Float]:
            return self.surface.eval_pdf(*args, **kwargs)

        def eval(self, *args: object, **kwargs: object) -> mi.Spectrum:
            return self.surface.eval_pdf(*args, **kwargs)[0]

        def pdf(self, *args: object, **kwargs: object) -> mi.Float:
            return self.surface.eval_pdf(*args, **kwargs)[1]

        def traverse(self, callback: mi.TraversalCallback) -> None:
            for name, parameter in self.surface.parameters().items():
                callback.put(name, parameter, mi.ParamFlags.Differentiable)

        def to_string(self) -> str:
            return f"NacreousBSDF[{self.surface}]"

    return NacreousBSDF


# ---- surfaces ----------------------------------------------------------------------------------------------


def _surface(props: mi.Properties) -> SmoothSurface | RoughSurface:
    if {"alpha_u", "alpha_v"} & set(props.keys()) or props.get("alpha", 0.0) != 0.0:
        return RoughSurface(props)
    return SmoothSurface(props)


class SmoothSurface:
    """A film on a plane: two directions, reflected and refracted."""

    def __init__(self, props: mi.Properties) -> None:
        self.film = Film(props, mi.BSDFFlags.DeltaReflection, mi.BSDFFlags.DeltaTransmission)

    def __str__(self) -> str:
        return f"{self.film.name}, smooth"

    def parameters(self) -> dict[str, mi.Texture]:
        """Return what `mi.traverse` finds."""
        return self.film.textures

    def sample(
        self,
        ctx: mi.BSDFContext,
        si: mi.SurfaceInteraction3f,
        sample1: mi.Float,
        sample2: mi.Point2f,  # noqa: ARG002 - Mitsuba's signature
        active: mi.Bool = True,  # noqa: FBT002 - Mitsuba's signature
    ) -> tuple[mi.BSDFSample3f, mi.Spectrum]:
        """Return one of the two directions, with the probability of choosing it, and its weight."""
        return self.film.scatter(ctx, si, mi.Normal3f(0, 0, 1), sample1, active)

    def eval_pdf(self, *_: object, **__: object) -> tuple[mi.Spectrum, mi.Float]:
        """Return 0 for any two directions: no two of a continuum are the mirror's."""
        return mi.Spectrum(0.0), mi.Float(0.0)


class RoughSurface:
    """A film on every facet of a rough surface."""

    def __init__(self, props: mi.Properties) -> None:
        names = ("alpha_u", "alpha_v") if "alpha_u" in props else ("alpha",)
        extra = mi.BSDFFlags.Anisotropic if len(names) == 2 else 0
        self.film = Film(
            props, mi.BSDFFlags.GlossyReflection | extra, mi.BSDFFlags.GlossyTransmission | extra
        )
        if self.film.transmits and self.film.eta == 1.0:
            raise ValueError(
                "expected different indices for a rough surface that transmits: between equal ones facets "
                "bend no light; leave out alpha, or move the .transmission file away"
            )
        self.distribution = _distribution(props)
        self.alpha = {name: props.get_unbounded_texture(name) for name in names}

    def __str__(self) -> str:
        return f"{self.film.name}, {self.distribution}, {self.alpha}"

    def parameters(self) -> dict[str, mi.Texture]:
        """Return what `mi.traverse` finds."""
        return self.film.textures | self.alpha

    def facets(self, si: mi.SurfaceInteraction3f, active: mi.Bool) -> mi.MicrofacetDistribution:
        """Return the distribution of normals at a point."""
        return mi.MicrofacetDistribution(
            self.distribution, *(texture.eval_1(si, active) for texture in self.alpha.values())
        )

    def sample(
        self,
        ctx: mi.BSDFContext,
        si: mi.SurfaceInteraction3f,
        sample1: mi.Float,
        sample2: mi.Point2f,
        active: mi.Bool = True,  # noqa: FBT002 - Mitsuba's signature
    ) -> tuple[mi.BSDFSample3f, mi.Spectrum]:
        """Return a direction by way of a facet seen from ω_i, its density, and f |cos θ_o| over that."""
        facets = self.facets(si, active)
        m, density = facets.sample(dr.mulsign(si.wi, si.wi.z), sample2)
        bs, weight = self.film.scatter(ctx, si, m, sample1, active & (density > 0))
        masking = facets.smith_g1(bs.wo, m)  # 0 for directions that leave through the facets
        density *= _jacobian(dr.dot(si.wi, m), dr.dot(bs.wo, m), bs.eta)
        bs.pdf = dr.select(masking > 0, bs.pdf * density, 0.0)
        return bs, weight * masking

    def eval_pdf(
        self,
        ctx: mi.BSDFContext,
        si: mi.SurfaceInteraction3f,
        wo: mi.Vector3f,
        active: mi.Bool = True,  # noqa: FBT002 - Mitsuba's signature
    ) -> tuple[mi.Spectrum, mi.Float]:
        """Return f |cos θ_o| and the density of `sample` for a pair of directions."""
        wi, reflects = si.wi, si.wi.z * wo.z > 0
        eta = dr.select(reflects, 1.0, self.film.relative_index(wi.z))
        m = dr.normalize(wi + wo * eta)
        m = dr.mulsign(m, m.z)
        cos_i, cos_o = dr.dot(wi, m), dr.dot(wo, m)
        # A facet is seen from its outer side alone: Walter et al. 2007, equation 34.
        active &= self.film.is_lit(wi) & (cos_i * wi.z > 0) & (cos_o * wo.z > 0)
        facets, lobes = self.facets(si, active), self.film.lobes(ctx, si, cos_i, active)
        jacobian = _jacobian(cos_i, cos_o, eta)
        shape = facets.eval(m) * facets.G(wi, wo, m) * dr.abs(cos_i / wi.z) * jacobian
        density = facets.pdf(dr.mulsign(wi, wi.z), m) * jacobian
        value, chance = lobes.chosen(reflects)
        return dr.select(active, value * shape, 0.0), dr.select(active, chance * density, 0.0)


def _jacobian(cos_i: mi.Float, cos_o: mi.Float, eta: mi.Float) -> mi.Float:
    """Return dω_m / dω_o for the cosines to the facet's normal; 1 / (4 cos) for reflection, η = 1."""
    return dr.abs(eta * eta * cos_o) / dr.square(cos_i + eta * cos_o)


def _distribution(props: mi.Properties) -> mi.MicrofacetType:
    known = {"ggx": mi.MicrofacetType.GGX, "beckmann": mi.MicrofacetType.Beckmann}
    name = props.get("distribution", "ggx")
    if name not in known:
        raise ValueError(f"expected the distribution ggx or beckmann, got {name}")
    return known[name]


# ---- the film ----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Lobes:
    """R and T as they weigh what is transported, and the probabilities with which each is sampled."""

    reflected: mi.Spectrum
    transmitted: mi.Spectrum
    reflection_chance: mi.Float
    transmission_chance: mi.Float

    def chosen(self, reflects: mi.Bool) -> tuple[mi.Spectrum, mi.Float]:
        """Return the value and the probability of one of the two."""
        return (
            dr.select(reflects, self.reflected, self.transmitted),
            dr.select(reflects, self.reflection_chance, self.transmission_chance),
        )


class Film:
    """The tables of a film, its textures, and the indices at both of its sides."""

    def __init__(self, props: mi.Properties, reflection: int, transmission: int) -> None:
        path = Path(str(mi.file_resolver().resolve(props["filename"])))
        file, companion = LookupFile(path, "R"), _transmission_path(path)
        self.name, self.reflectance = path.name, read_table(file)
        self.flags, self.transmits = (+reflection, +transmission), companion.is_file()
        if self.transmits:
            self.transmittance = read_table(LookupFile(companion, "T"))
        self.eta = _relative_index(props, file) if self.transmits else 1.0
        for name in ("int_ior", "ext_ior"):
            props.mark_queried(name)  # an opaque film has no use for them, and a scene may keep them
        self.textures = {"thickness_scale": props.get_unbounded_texture("thickness_scale", 1.0)}
        for name in ("specular_reflectance", "specular_transmittance"):
            if name in props:
                self.textures[name] = props.get_texture(name)

    def components(self) -> list[int]:
        """Return the flags of each lobe, with the sides it is seen from."""
        if not self.transmits:
            return [self.flags[0] | mi.BSDFFlags.FrontSide]
        sides = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
        return [self.flags[0] | sides, self.flags[1] | sides | mi.BSDFFlags.NonSymmetric]

    def is_lit(self, wi: mi.Vector3f) -> mi.Bool:
        """Tell where ω_i is on a side that scatters."""
        return wi.z != 0 if self.transmits else wi.z > 0

    def relative_index(self, cos_theta_i: mi.Float) -> mi.Float:
        """Return η = n_o / n_i of refraction."""
        return dr.select(cos_theta_i > 0, self.eta, 1 / self.eta)

    def scatter(
        self,
        ctx: mi.BSDFContext,
        si: mi.SurfaceInteraction3f,
        m: mi.Normal3f,
        sample1: mi.Float,
        active: mi.Bool,
    ) -> tuple[mi.BSDFSample3f, mi.Spectrum]:
        """Reflect or refract at a facet; the density is the probability of that, the weight is over it."""
        cos_i = dr.dot(si.wi, m)
        lobes = self.lobes(ctx, si, cos_i, active)
        reflects = sample1 < lobes.reflection_chance
        value, chance = lobes.chosen(reflects)
        active &= self.is_lit(si.wi) & (chance > 0)
        _, cos_t, eta_it, eta_ti = mi.fresnel(cos_i, mi.Float(self.eta))
        bs = dr.zeros(mi.BSDFSample3f)
        refracted = dr.select(cos_t == 0, si.wi, mi.refract(si.wi, m, cos_t, eta_ti))  # 0: there is none
        bs.wo = dr.select(reflects, mi.reflect(si.wi, m), refracted)
        bs.eta = dr.select(reflects, 1.0, eta_it)
        bs.pdf = dr.select(active, chance, 0.0)
        bs.sampled_component = dr.select(reflects, mi.UInt32(0), mi.UInt32(1))
        bs.sampled_type = dr.select(reflects, *(mi.UInt32(flags) for flags in self.flags))
        return bs, dr.select(active, value / dr.select(active, chance, 1.0), 0.0)

    def lobes(
        self, ctx: mi.BSDFContext, si: mi.SurfaceInteraction3f, cos_i: mi.Float, active: mi.Bool
    ) -> Lobes:
        """Return what a facet does with light whose cosine to its normal is `cos_i`, negative from inside."""
        _, cos_t, _, eta_ti = mi.fresnel(cos_i, mi.Float(self.eta))  # for Snell's law: F is in the table
        cos_theta, total = dr.select(cos_i > 0, cos_i, dr.abs(cos_t)), cos_t == 0
        scale = self.textures["thickness_scale"].eval_1(si, active)
        reflected = transmitted = mi.Spectrum(0.0)
        if ctx.is_enabled(mi.BSDFFlags.Reflection, 0):
            outside = self.reflectance.at(si, cos_theta, scale, active)
            reflected = dr.select(total & (cos_i < 0), 1.0, outside)
            reflected *= self.tint("specular_reflectance", si, active)
        if self.transmits and ctx.is_enabled(mi.BSDFFlags.Transmission, 1):
            transmitted = dr.select(total, 0.0, self.transmittance.at(si, cos_theta, scale, active))
            transmitted *= self.tint("specular_transmittance", si, active)
        r, t = (dr.detach(dr.mean(dr.abs(value))) for value in (reflected, transmitted))
        some = dr.select(r + t > 0, r + t, 1.0)
        radiance = dr.square(eta_ti) if ctx.mode == mi.TransportMode.Radiance else 1.0
        return Lobes(reflected, transmitted * radiance, r / some, t / some)

    def tint(self, name: str, si: mi.SurfaceInteraction3f, active: mi.Bool) -> mi.Spectrum | float:
        """Return what a colour is multiplied by."""
        return self.textures[name].eval(si, active) if name in self.textures else 1.0


def _transmission_path(path: Path) -> Path:
    """Return where Nacreous writes T beside R: film.spectral.exr, film.transmission.spectral.exr."""
    stem, dot, suffix = path.name.partition(".spectral.")
    return path.with_name(f"{stem}.transmission{dot}{suffix}" if dot else f"{path.stem}.transmission.exr")


def _relative_index(props: mi.Properties, file: LookupFile) -> float:
    indices = [_index(props, "int_ior", file, "substrate"), _index(props, "ext_ior", file, "incident")]
    if min(indices) <= 0:
        raise ValueError(f"expected int_ior and ext_ior above 0, got {indices}")
    return indices[0] / indices[1]


def _index(props: mi.Properties, name: str, file: LookupFile, medium: str) -> float:
    """Return the parameter, or the constant index that the table's spec has for a medium."""
    if name in props:
        return float(props[name])
    material = file.spec.get("stack", {}).get(medium)
    index = material.get("n") if isinstance(material, dict) else CONSTANT_INDEX.get(material)
    if not isinstance(index, (int, float)):
        raise ValueError(  # noqa: TRY004 - a material of another kind is a value of the same JSON
            f"expected {name}, the index at which to refract: the {medium} medium of {file.path.name} is "
            f"{material}, which has no single one that this plugin knows; for example {name} = 1.5"
        )
    return float(index)
