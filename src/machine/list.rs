//! What the list of machines makes: the machine of a profile, its text, and the kinds there are. Everything
//! else that names a machine asks the list, or the trait.

use super::own::{Own, own_machines};
use super::{BUILTIN, Form, Intake, Kind, Rasterizer};
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, EnumAccess, Visitor};
use std::fmt::Formatter;

/// The list of machines, one line each: `Variant(Configuration) in module;`. Makes the profile's [`Form`] and
/// what asks it.
macro_rules! machines {
    ($($(#[$doc:meta])* $variant:ident($config:ty) in $module:ident;)*) => {
        /// The machine of a profile.
        ///
        /// What a machine does is asked through [`Rasterizer`], which a form dereferences to.
        #[derive(Clone, Debug, PartialEq, Eq)]
        #[cfg_attr(feature = "verification", derive(schemars::JsonSchema))]
        #[cfg_attr(feature = "verification", schemars(rename_all = "kebab-case",
            deny_unknown_fields,
            description = "The machine of a profile."))]
        pub enum Form {
            $($(#[$doc])* $variant($config),)*
            /// A machine that is not built in.
            #[cfg_attr(feature = "verification", schemars(skip))]
            Own(OwnForm),
        }

        /// The built-in machines.
        const BUILTIN: &[&Kind] = &[$(&$module::KIND,)*];

        impl std::ops::Deref for Form {
            type Target = dyn Rasterizer;

            fn deref(&self) -> &Self::Target {
                match self {
                    $(Self::$variant(config) => list::Configured::configured(config),)*
                    Self::Own(own) => own.rasterizer(),
                }
            }
        }

        impl std::ops::DerefMut for Form {
            fn deref_mut(&mut self) -> &mut Self::Target {
                match self {
                    $(Self::$variant(config) => list::Configured::configured_mut(config),)*
                    Self::Own(own) => own.rasterizer_mut(),
                }
            }
        }

        $(impl From<$config> for Form {
            fn from(config: $config) -> Self {
                Self::$variant(config)
            }
        })*

        impl serde::Serialize for Form {
            fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                let name = self.name();
                match self {
                    $(Self::$variant(config) => to.serialize_newtype_variant("Form", 0, name, config),)*
                    Self::Own(own) => to.serialize_newtype_variant("Form", 0, name, own),
                }
            }
        }

        impl Form {
            /// Reads the configuration of the built-in machine of this name, or of one's own.
            fn read<'de, A: serde::de::VariantAccess<'de>>(
                name: &str,
                from: A,
            ) -> Result<Self, A::Error> {
                $(if name == $module::KIND.name {
                    return from.newtype_variant::<$config>().map(Self::$variant);
                })*
                own::read(name, from)
            }
        }
    };
}
pub(super) use machines;

/// A configuration, boxed or not, as a rasterizer.
pub(super) trait Configured {
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
pub(super) fn unknown(name: &str) -> String {
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
        // The names are in the visitor, as those of one's own are not known here.
        from.deserialize_enum("Form", &[], FormVisitor)
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
