//! Signals that ask a run to end: the first lets it end its files, the second ends the program at once.
//!
//! Not here: SIGHUP, which `nohup` must go on to keep away.

use std::io;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// What asked the run to end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Signal {
    /// SIGINT.
    Interrupt,
    /// SIGTERM.
    Terminate,
}

impl Signal {
    /// As users know it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Interrupt => "Ctrl-C (SIGINT)",
            Self::Terminate => "SIGTERM",
        }
    }

    /// 128 and the number of the signal, as shells have it.
    pub fn exit_code(self) -> u8 {
        match self {
            Self::Interrupt => 130,
            Self::Terminate => 143,
        }
    }
}

/// What the process has received, for whom asks without an [`Interruption`].
static RECEIVED: OnceLock<Arc<AtomicUsize>> = OnceLock::new();

/// Whether a signal came: what an engine asks in the midst of a long step.
pub fn is_wanted() -> bool {
    RECEIVED
        .get()
        .is_some_and(|received| received.load(Ordering::Relaxed) != 0)
}

/// Whether the run shall end.
#[derive(Debug, Default)]
pub struct Interruption {
    /// Number of the signal, 0 as long as there was none.
    received: Arc<AtomicUsize>,
}

impl Interruption {
    /// Notes signals from now on.
    ///
    /// # Errors
    /// The system does not let us.
    pub fn listen() -> io::Result<Self> {
        let (listener, again) = (Self::default(), Arc::new(AtomicBool::new(false)));
        for (signal, code) in [(SIGINT, 130), (SIGTERM, 143)] {
            // In this order: the first signal finds `again` unset.
            flag::register_conditional_shutdown(signal, code, Arc::clone(&again))?;
            flag::register(signal, Arc::clone(&again))?;
            flag::register_usize(signal, Arc::clone(&listener.received), signal as usize)?;
        }
        RECEIVED.get_or_init(|| Arc::clone(&listener.received));
        Ok(listener)
    }

    /// The signal that came, if one did.
    pub fn received(&self) -> Option<Signal> {
        match self.received.load(Ordering::Relaxed) as i32 {
            SIGINT => Some(Signal::Interrupt),
            SIGTERM => Some(Signal::Terminate),
            _ => None,
        }
    }
}
