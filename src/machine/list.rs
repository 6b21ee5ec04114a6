//! The list of machines: one line each. Everything else that names a machine asks this list, or the trait.

use super::own::{Own, OwnForm, own_machines};
use super::{Intake, Kind, Rasterizer};
use schemars::JsonSchema;
use serde::de::{DeserializeSeed, Deserializer, EnumAccess, Error as _, VariantAccess, Visitor};
use serde::{Deserialize, Serialize, Serializer};
use std::fmt::Formatter;
use std::ops::{Deref, DerefMut};

macro_rules! machines {
    ($($(#[$doc:meta])* $variant:ident($config:ty) in $module:ident;)*) => {
        /// The machine of a profile.
        ///
        /// What a machine does is asked through [`Rasterizer`], which a form dereferences to.
        #[derive(Clone, Debug, PartialEq, Eq, JsonSchema)]
        #[schemars(rename_all = "kebab-case", deny_unknown_fields, description = "The machine of a profile.")]
        pub enum Form {
            $($(#[$doc])* $variant($config),)*
            /// A machine that is not built in.
            #[schemars(skip)]
            Own(OwnForm),
        }

        /// The built-in machines.
        const BUILTIN: &[&Kind] = &[$(&super::$module::KIND,)*];
        /// The names that profiles use for them.
        const NAMES: &[&str] = &[$(super::$module::KIND.name,)*];

        impl Deref for Form {
            type Target = dyn Rasterizer;

            fn deref(&self) -> &Self::Target {
                match self {
                    $(Self::$variant(config) => Configured::configured(config),)*
                    Self::Own(own) => own.rasterizer(),
                }
            }
        }

        impl DerefMut for Form {
            fn deref_mut(&mut self) -> &mut Self::Target {
                match self {
                    $(Self::$variant(config) => Configured::configured_mut(config),)*
                    Self::Own(own) => own.rasterizer_mut(),
                }
            }
        }

        $(impl From<$config> for Form {
            fn from(config: $config) -> Self {
                Self::$variant(config)
            }
        })*

        impl Serialize for Form {
            fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                let name = self.name();
                match self {
                    $(Self::$variant(config) => to.serialize_newtype_variant("Form", 0, name, config),)*
                    Self::Own(own) => to.serialize_newtype_variant("Form", 0, name, own),
                }
            }
        }

        impl Form {
            /// Reads the configuration of the machine of this name.
            fn read<'de, A: VariantAccess<'de>>(name: &str, from: A) -> Result<Self, A::Error> {
                $(if name == super::$module::KIND.name {
                    return from.newtype_variant::<$config>().map(Self::$variant);
                })*
                match own_machines().iter().find(|own| own.kind().name == name) {
                    Some(own) => own.read(from.newtype_variant()?).map_err(A::Error::custom),
                    None => Err(A::Error::custom(unknown(name))),
                }
            }
        }
    };
}

machines! {
    /// Three edge functions over the bounding box (Pineda), or in the order of `[traversal]`.
    EdgeFunction(super::EdgeFunctionConfig) in edge_function;
    /// Three x DDAs, depth on a plane (VGX).
    EdgeWalk(super::EdgeWalkConfig) in edge_walk;
    /// x and depth walked down the edges, depth along each span (GTX).
    Gouraud(super::GouraudConfig) in gouraud;
    /// An engine at every pixel (Pixel-Planes 4).
    EnginePerPixel(super::EnginePerPixelConfig) in engine_per_pixel;
    /// An approximate walk, edge functions as a mask, barycentric values (InfiniteReality).
    Barycentric(super::BarycentricConfig) in barycentric;
    /// Small tiles, an engine each (Bali).
    Tiles(super::TilesConfig) in tiles;
    /// Homogeneous recursive descent (Olano and Greer).
    Homogeneous(super::HomogeneousConfig) in homogeneous;
    /// Exact sides and spans between them (Crow).
    Scanline(super::ScanlineConfig) in scanline;
    /// A machine that begins at registers.
    Registers(Box<super::RegisterConfig>) in register;
}

/// A configuration, boxed or not, as a rasterizer.
trait Configured {
    fn configured(&self) -> &(dyn Rasterizer + 'static);
    fn configured_mut(&mut self) -> &mut (dyn Rasterizer + 'static);
}

impl<C: Rasterizer + 'static> Configured for C {
    fn configured(&self) -> &(dyn Rasterizer + 'static) {
        self
    }

    fn configured_mut(&mut self) -> &mut (dyn Rasterizer + 'static) {
        self
    }
}

impl Configured for Box<super::RegisterConfig> {
    fn configured(&self) -> &(dyn Rasterizer + 'static) {
        &**self
    }

    fn configured_mut(&mut self) -> &mut (dyn Rasterizer + 'static) {
        &mut **self
    }
}

/// Every machine: the built-in ones, then those of [`super::add`].
pub fn kinds() -> impl Iterator<Item = &'static Kind> {
    BUILTIN.iter().copied().chain(own_machines().iter().map(Own::kind))
}

/// The machines that take triangles, so that one profile can be seen through each of them.
pub fn triangle_machines() -> impl Iterator<Item = &'static Kind> {
    kinds().filter(|kind| kind.intake == Intake::Triangles)
}

/// What is wrong with a name that no machine has.
fn unknown(name: &str) -> String {
    let known: Vec<String> = kinds().map(|kind| format!("`{}`", kind.name)).collect();
    format!("unknown variant `{name}`, expected one of {}", known.join(", "))
}

impl Form {
    /// The name profiles use.
    pub fn name(&self) -> &'static str {
        self.kind().name
    }
}

impl<'de> Deserialize<'de> for Form {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_enum("Form", NAMES, FormVisitor)
    }
}

struct FormVisitor;

impl<'de> Visitor<'de> for FormVisitor {
    type Value = Form;

    fn expecting(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.write_str("enum Form")
    }

    fn visit_enum<A: EnumAccess<'de>>(self, data: A) -> Result<Form, A::Error> {
        let (name, variant) = data.variant_seed(Name)?;
        Form::read(name, variant)
    }
}

/// The name of a machine, checked where it stands, so that an error points there.
struct Name;

impl<'de> DeserializeSeed<'de> for Name {
    type Value = &'static str;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<&'static str, D::Error> {
        from.deserialize_identifier(self)
    }
}

impl Visitor<'_> for Name {
    type Value = &'static str;

    fn expecting(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.write_str("variant identifier")
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<&'static str, E> {
        let found = kinds().find(|kind| kind.name == text);
        found.map(|kind| kind.name).ok_or_else(|| E::custom(unknown(text)))
    }
}
