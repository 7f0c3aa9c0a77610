//! The macro that makes a library of a scene: `jostle::export_fmu!(jostle::scene::packing::PackingInput);`

/// Exports a [`Scene`](crate::scene::Scene) as the 44 functions of FMI 2.0 and the 75 of FMI 3.0.
///
/// Use it once in a crate of type `cdylib`. The functions are in the modules `fmi2` and `fmi3` of that crate, too.
#[macro_export]
macro_rules! export_fmu {
    ($scene:ty) => {
        $crate::export_fmi2!($scene);
        $crate::export_fmi3!($scene);
    };
}

/// Writes exported functions from their signatures in the standard's header and the call that answers them.
#[doc(hidden)]
#[macro_export]
macro_rules! __fmi_functions {
    ($(fn $name:ident($($argument:ident: $kind:ty),* $(,)?) $(-> $result:ty)? = $answer:expr;)*) => {$(
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name($($argument: $kind),*) $(-> $result)? {
            $(let _ = &$argument;)* // some arguments have no use here
            // SAFETY: the importer's promise about its pointers, passed on unchanged.
            unsafe { $answer }
        }
    )*};
}
