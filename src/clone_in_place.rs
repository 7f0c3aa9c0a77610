//! `Clone` whose `clone_from` allocates nothing where there is room, which the derived one does not promise: the backup of
//! every call and the observation between grid points copy the whole state.

/// Implements it for a struct, of which all fields are listed.
macro_rules! clone_in_place {
    ($type:ident { $($field:ident),+ }) => {
        impl Clone for $type {
            fn clone(&self) -> Self {
                Self { $($field: Clone::clone(&self.$field)),+ }
            }

            fn clone_from(&mut self, source: &Self) {
                $(Clone::clone_from(&mut self.$field, &source.$field);)+
            }
        }
    };
}
pub(crate) use clone_in_place;
