//! The macro that makes a library of a model: `fmi_component::export_fmu!(Pendulum);`

/// Exports a [`Model`](crate::Model) or a struct with [`#[derive(Component)]`](derive@crate::Component) as the 44 functions of FMI 2.0 and the 75 of FMI 3.0.
///
/// Besides, the library gets `fmi_component_describe`, by which programs that write FMUs ask it for its variables: see
/// [`c_api::description`](crate::c_api::description).
///
/// Use it once in a crate of type `cdylib`. The functions are in the modules `fmi2` and `fmi3` of that crate, too. All but the
/// making of an instance call functions of this crate that are the same for every model. A static of type
/// [`ModelType`](crate::ModelType) is exported by `export_fmu!(dyn &NAME)`: a model of another crate is then compiled there alone.
#[macro_export]
macro_rules! export_fmu {
    (dyn $model:expr) => {
        $crate::export_fmi2!($model);
        $crate::export_fmi3!($model);
        $crate::__export_description!($model);
    };
    ($model:ty) => {
        $crate::export_fmu!(dyn &$crate::ModelType::of::<<$model as $crate::Export>::Model>());
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

/// Writes exported functions that are calls of an instance: their first argument is the instance, they return a status, and the
/// function that answers them gets an [`Entry`](crate::c_api::Entry) before the arguments that are written here.
#[doc(hidden)]
#[macro_export]
macro_rules! __fmi_calls {
    (
        $version:ident;
        $(fn $name:ident($($argument:ident: $kind:ty),* $(,)?) = $($answer:ident)::+($($given:expr),* $(,)?);)*
    ) => {$(
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(pointer: $crate::c_api::Opaque, $($argument: $kind),*) -> $crate::c_api::Status {
            $(let _ = &$argument;)* // some arguments have no use here
            let entry = $crate::c_api::Entry { pointer, version: $version, function: stringify!($name) };
            // SAFETY: the importer's promise about its pointers, passed on unchanged.
            unsafe { $($answer)::+(entry, $($given),*) }
        }
    )*};
}
