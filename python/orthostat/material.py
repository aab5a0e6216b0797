# SPDX-License-Identifier: BSD-3-Clause
"""Orthotropic materials."""
import numpy

from ._library import array, ffi, lib, pointer_to, text_of
from .context import context_of

_RULES = {"geometric": "OST_SHEAR_GEOMETRIC", "arithmetic": "OST_SHEAR_ARITHMETIC", "min": "OST_SHEAR_MIN",
          "max": "OST_SHEAR_MAX"}
_RATIOS = ("nu12", "nu21", "nu23", "nu32", "nu31", "nu13")


class Material:
    """A material, as a case states it: a modulus and Poisson's ratio (isotropic); three moduli and one ratio (the stable
    family, shear moduli by `shear_rule`); or nine constants, with ratios nu12 nu23 nu31 or by name ({"nu12": 0.4, …}),
    and shear moduli G12 G23 G31. One that is not definite is refused."""

    def __init__(self, youngs_modulus, poissons_ratio, shear_modulus=None, density=0.0, name="material",
                 shear_rule="geometric", comm=None):
        context = context_of(comm)
        constants = ffi.new("OstOrthotropic *")
        if numpy.ndim(youngs_modulus) == 0:
            constants[0] = lib.ost_orthotropic_isotropic(youngs_modulus, poissons_ratio)
        elif shear_modulus is None:
            if numpy.ndim(poissons_ratio) or isinstance(poissons_ratio, dict):
                raise ValueError("shear_modulus: three Poisson's ratios want three shear moduli, G12 G23 G31")
            if shear_rule not in _RULES:
                raise ValueError(f"shear_rule: '{shear_rule}' is none of {', '.join(_RULES)}")
            moduli = array(youngs_modulus, (3,), "youngs_modulus")
            constants[0] = lib.ost_orthotropic_family(pointer_to(moduli), poissons_ratio, getattr(lib, _RULES[shear_rule]))
        else:
            _nine(context, name, youngs_modulus, poissons_ratio, shear_modulus, constants)
        self.struct = ffi.new("OstMaterial *")
        self.context = context
        context.check(lib.ost_material_create(context.pointer, name.encode(), constants, density, self.struct))

    def __repr__(self):
        e, nu, g = self.youngs_modulus, self.poissons_ratio, self.shear_modulus
        return f"<orthostat.Material {self.name}: E {e}, nu12 nu23 nu31 {nu}, G12 G23 G31 {g}>"

    name = property(lambda self: text_of(self.struct.name))
    density = property(lambda self: self.struct.density)
    is_isotropic = property(lambda self: bool(self.struct.isotropic))
    youngs_modulus = property(lambda self: numpy.array(list(self.struct.constants.youngs_modulus)))
    poissons_ratio = property(lambda self: numpy.array(list(self.struct.constants.poissons_ratio)))
    shear_modulus = property(lambda self: numpy.array(list(self.struct.constants.shear_modulus)))

    def stiffness(self, axes=None):
        """(6, 6): 11 22 33 12 23 31, in the material's axes, or in the world's for axes with rows e1 e2 e3."""
        return self._turned(self.struct.stiffness, axes, lib.ost_material_rotate_stiffness)

    def compliance(self, axes=None):
        """(6, 6): the inverse of the stiffness."""
        return self._turned(self.struct.compliance, axes, lib.ost_material_rotate_compliance)

    def _turned(self, values, axes, turn):
        own = numpy.array(list(values))
        if axes is not None:
            world, axes = numpy.empty(36), array(axes, (3, 3), "axes").copy()
            self.context.check(lib.ost_axes_check(self.context.pointer, b"axes", pointer_to(axes)))
            turn(pointer_to(own), pointer_to(axes), pointer_to(world))
            own = world
        return own.reshape(6, 6)


def _nine(context, name, youngs_modulus, poissons_ratio, shear_modulus, constants):
    named = poissons_ratio if isinstance(poissons_ratio, dict) else dict(zip(("nu12", "nu23", "nu31"), poissons_ratio))
    unknown = set(named) - set(_RATIOS)
    if unknown:
        raise ValueError(f"poissons_ratio: {', '.join(sorted(unknown))} is none of {', '.join(_RATIOS)}")
    moduli = array(youngs_modulus, (3,), "youngs_modulus")
    ratios = numpy.array([named.get(ratio, numpy.nan) for ratio in _RATIOS], float)
    shear = array(shear_modulus, (3,), "shear_modulus")
    context.check(lib.ost_orthotropic_named(context.pointer, name.encode(), pointer_to(moduli), pointer_to(ratios),
                                            pointer_to(shear), constants))
