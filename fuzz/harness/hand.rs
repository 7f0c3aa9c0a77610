//! What a careless caller has at hand: numbers, texts and pointers, drawn from the fuzzer's bytes.
//!
//! Pointers are null, misaligned, or to buffers as long as any length that is passed with them; a length that no memory has
//! is passed too. That is all a C caller can get wrong short of lying about memory, which no library can see.

use std::cell::RefCell;
use std::ffi::{CString, c_char};
use std::io::Write;
use std::sync::atomic::{AtomicU64, Ordering};

/// Elements of every buffer.
pub const LONGEST: usize = 16;

thread_local! {
    /// What the calls are drawn from.
    static INPUT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

static CALLS: AtomicU64 = AtomicU64::new(0);
/// Those among them that callbacks made.
static INSIDE: AtomicU64 = AtomicU64::new(0);
static STEPS: AtomicU64 = AtomicU64::new(0);

/// Counts a call into the library under test and says how many there were, now and then.
pub fn count() {
    let calls = CALLS.fetch_add(1, Ordering::Relaxed) + 1;
    if calls.is_multiple_of(10_000) {
        eprintln!("calls: {calls} steps: {}", STEPS.load(Ordering::Relaxed));
    }
}

/// Counts a call that a callback makes.
pub fn count_inside() {
    INSIDE.fetch_add(1, Ordering::Relaxed);
    count();
}

/// Counts a step forward in time that was done, among the calls.
pub fn count_step(done: bool) {
    STEPS.fetch_add(u64::from(done), Ordering::Relaxed);
}

/// Calls until now, those that callbacks made, and steps forward in time that were done.
#[allow(dead_code)] // the fuzzer's log says what it needs
pub fn counted() -> [u64; 3] {
    let [all, inside, steps] = [&CALLS, &INSIDE, &STEPS].map(|count| count.load(Ordering::Relaxed));
    [all - inside, inside, steps]
}

/// Panics that a model was set to do are not reported; any other ends the process, though the boundary catches it.
pub fn report_defects() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        std::panic::set_hook(Box::new(|panic| {
            let message = panic.payload().downcast_ref::<String>();
            if !message.is_some_and(|text| text.starts_with("set to panic")) {
                let input =
                    INPUT.with_borrow(|input| input.iter().map(|byte| format!("{byte:02x}")).collect::<String>());
                // Straight to the file, past what gathers the output of tests: the process ends here.
                let _ = writeln!(std::io::stderr(), "DEFECT: {panic}\nInput, to be repeated: {input}");
                std::process::abort();
            }
        }));
    });
}

/// Buffers that pointers lead to. Behind a raw pointer, since several are lent to one call.
#[allow(dead_code)] // each library has functions of some types only
pub struct Buffers {
    pub references: [u32; LONGEST],
    pub reals: [f64; LONGEST],
    pub integers: [i32; LONGEST],
    pub longs: [i64; LONGEST],
    pub sizes: [usize; LONGEST],
    pub texts: [*const c_char; LONGEST],
    pub binaries: [*const u8; LONGEST],
    pub bytes: [u8; 8 * LONGEST],
}

pub struct Hand<'a> {
    rest: &'a [u8],
    buffers: *mut Buffers,
    texts: &'a [CString],
    /// Variables of the scene.
    variables: u32,
}

impl Drop for Hand<'_> {
    fn drop(&mut self) {
        // SAFETY: made by `Box::into_raw` in `new`.
        drop(unsafe { Box::from_raw(self.buffers) });
    }
}

impl<'a> Hand<'a> {
    pub fn new(bytes: &'a [u8], variables: u32, texts: &'a [CString]) -> Self {
        INPUT.with_borrow_mut(|input| {
            input.clear();
            input.extend_from_slice(bytes);
        });
        let buffers = Box::new(Buffers {
            references: [0; LONGEST],
            reals: [0.0; LONGEST],
            integers: [0; LONGEST],
            longs: [0; LONGEST],
            sizes: [0; LONGEST],
            texts: [std::ptr::null(); LONGEST],
            binaries: [std::ptr::null(); LONGEST],
            bytes: [0; 8 * LONGEST],
        });
        Self {
            rest: bytes,
            buffers: Box::into_raw(buffers),
            texts,
            variables,
        }
    }

    pub fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }

    pub fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.rest.split_first() else {
            return 0;
        };
        self.rest = rest;
        *first
    }

    pub fn below(&mut self, end: usize) -> usize {
        usize::from(self.byte()) % end
    }

    /// One in `parts`.
    pub fn rarely(&mut self, parts: usize) -> bool {
        self.below(parts) == parts - 1
    }

    pub fn word(&mut self) -> u64 {
        let mut bytes = [0; 8];
        bytes.fill_with(|| self.byte());
        u64::from_le_bytes(bytes)
    }

    pub fn real(&mut self) -> f64 {
        const POOL: [f64; 20] = [
            0.0,
            -0.0,
            1.0,
            -1.0,
            1e-3,
            0.01,
            0.1,
            2.0,
            1e-9,
            5e-324,
            1e3,
            1e10,
            1e300,
            -1e300,
            f64::MAX,
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            0.5,
            0.02,
        ];
        match self.below(POOL.len() + 2) {
            index if index < POOL.len() => POOL[index],
            index if index == POOL.len() => f64::from_bits(self.word()),
            _ => f64::from(self.byte()) / 64.0 - 2.0,
        }
    }

    /// A duration: three in four are of some use, and none is longer than `longest`.
    pub fn duration(&mut self, longest: f64) -> f64 {
        const USEFUL: [f64; 6] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-9, 0.01];
        let index = self.below(8);
        let duration = USEFUL.get(index).copied().unwrap_or_else(|| self.real());
        if duration.is_finite() {
            duration.min(longest)
        } else {
            duration
        }
    }

    pub fn reference(&mut self) -> u32 {
        if self.rarely(16) {
            return self.word() as u32;
        }
        u32::from(self.byte()) % (self.variables + 2)
    }

    /// A length: mostly one that the buffers have.
    pub fn length(&mut self) -> usize {
        match self.below(12) {
            0 => 0,
            1 => usize::MAX,
            2 => LONGEST,
            3 => self.below(LONGEST),
            _ => 1 + self.below(3),
        }
    }

    pub fn buffers(&mut self) -> *mut Buffers {
        self.buffers
    }

    /// Null, misaligned, or as it is.
    pub fn spoil<T>(&mut self, pointer: *mut T) -> *mut T {
        match self.below(24) {
            0 => std::ptr::null_mut(),
            1 if size_of::<T>() > 1 => pointer.wrapping_byte_add(1),
            _ => pointer,
        }
    }

    pub fn text(&mut self) -> *const c_char {
        let index = self.below(self.texts.len() + 1);
        self.texts.get(index).map_or(std::ptr::null(), |text| text.as_ptr())
    }

    /// Pointers that a getter has handed out lead nowhere after the next call of a getter: none of them is passed on.
    fn forget_lent(&mut self) {
        // SAFETY: the buffers live as long as the hand, and no reference into them does.
        unsafe {
            (*self.buffers).texts = [std::ptr::null(); LONGEST];
            (*self.buffers).binaries = [std::ptr::null(); LONGEST];
        }
    }

    /// Null, or the bytes of the buffer, which are as many as any of [`BinarySizes`].
    fn binary(&mut self) -> *const u8 {
        match self.below(4) {
            0 => std::ptr::null(),
            // SAFETY: the buffers live as long as the hand.
            _ => unsafe { (&raw const (*self.buffers).bytes).cast() },
        }
    }

    /// Damages bytes that are to be read back, and mends their checksum now and then, so that what is behind it is reached.
    pub fn damage(&mut self, bytes: &mut Vec<u8>) {
        for _ in 0..self.below(4) {
            let (at, new) = (self.word() as usize % bytes.len().max(1), self.byte());
            match self.below(5) {
                0 => bytes.truncate(at),
                1 => bytes.push(new),
                2 => {
                    let real = self.real().to_le_bytes();
                    bytes.iter_mut().skip(at).zip(real).for_each(|(byte, new)| *byte = new);
                }
                _ => bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte = new),
            }
        }
        if let Some(end) = bytes.len().checked_sub(4)
            && self.below(4) > 0
        {
            let sum = crc32fast::hash(&bytes[..end]).to_le_bytes();
            bytes[end..].copy_from_slice(&sum);
        }
    }
}

/// Draws an argument of one role.
pub trait Draw {
    type Argument;
    fn draw(hand: &mut Hand) -> Self::Argument;
}

/// A role by its draw.
macro_rules! roles {
    ($($role:ident -> $kind:ty = |$hand:ident| $draw:expr;)*) => {$(
        #[allow(dead_code)] // each library has functions of some roles only
        pub struct $role;
        impl Draw for $role {
            type Argument = $kind;
            fn draw($hand: &mut Hand) -> $kind {
                $draw
            }
        }
    )*};
}

/// Fills a buffer with draws and lends it, spoiled now and then.
macro_rules! filled {
    ($hand:ident, $field:ident, $draw:expr) => {{
        for index in 0..3 {
            let value = $draw;
            // SAFETY: the buffers live as long as the hand, and no reference into them does.
            unsafe { (*$hand.buffers()).$field[index] = value };
        }
        // SAFETY: as above.
        let pointer = unsafe { &raw mut (*$hand.buffers()).$field };
        $hand.spoil(pointer.cast())
    }};
}

roles! {
    Real -> f64 = |hand| hand.real();
    Flag -> u8 = |hand| hand.byte();
    Whole -> i32 = |hand| i32::from(hand.byte() as i8);
    Reference -> u32 = |hand| hand.reference();
    Length -> usize = |hand| hand.length();
    Text -> *const c_char = |hand| hand.text();
    References -> *mut u32 = |hand| filled!(hand, references, hand.reference());
    Reals -> *mut f64 = |hand| filled!(hand, reals, hand.real());
    Wholes -> *mut i32 = |hand| filled!(hand, integers, i32::from(hand.byte()));
    Longs -> *mut i64 = |hand| filled!(hand, longs, i64::from(hand.byte()));
    Sizes -> *mut usize = |hand| filled!(hand, sizes, usize::from(hand.byte()));
    Texts -> *mut *const c_char = |hand| { hand.forget_lent(); filled!(hand, texts, hand.text()) };
    Bytes -> *mut u8 = |hand| filled!(hand, bytes, hand.byte());
    Singles -> *mut f32 = |hand| filled!(hand, reals, hand.real());
    Tiny -> *mut i8 = |hand| filled!(hand, bytes, hand.byte());
    Short -> *mut i16 = |hand| filled!(hand, integers, 0);
    UnsignedShort -> *mut u16 = |hand| filled!(hand, integers, 0);
    UnsignedLongs -> *mut u64 = |hand| filled!(hand, longs, i64::from(hand.byte()));
    Zeros -> *mut i32 = |hand| filled!(hand, integers, 0);
    Nothing -> *mut std::ffi::c_void = |_hand| std::ptr::null_mut();
    BinarySizes -> *mut usize = |hand| filled!(hand, sizes, usize::from(hand.byte()) % (8 * LONGEST + 1));
    Binaries -> *mut *const u8 = |hand| { hand.forget_lent(); filled!(hand, binaries, hand.binary()) };
}
