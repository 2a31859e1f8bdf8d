//! How a stage's criteria are written down: name, type, default and meaning in one place.

/// A structure of criteria with its defaults. What the documentation of a field says is written
/// above its key when the criteria are printed.
macro_rules! criteria {
    (
        $(#[doc = $what:literal])+
        $name:ident {
            $( $(#[doc = $doc:literal])+ $field:ident: $type:ty = $default:expr, )+
        }
    ) => {
        $(#[doc = $what])+
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
        #[serde(default, deny_unknown_fields)]
        pub struct $name {
            $( $(#[doc = $doc])+ pub $field: $type, )+
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $( $field: $default, )+ }
            }
        }

        impl $name {
            /// TOML lines, each key below its meaning.
            pub(super) fn commented(&self) -> String {
                let mut text = String::new();
                $(
                    $( text += concat!("#", $doc, "\n"); )+
                    text += &format!("{} = {:?}\n", stringify!($field), self.$field);
                )+
                text
            }
        }
    };
}

pub(super) use criteria;
