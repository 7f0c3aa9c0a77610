# Sourced after common.sh by scripts that compile for other systems.

# The folder of the private toolchain, if rustup has no targets to give: Debian's rustc-web, unpacked and not installed.
cross_toolchain="${JOSTLE_CROSS_TOOLCHAIN:-$root/build/cross}"

# use_target TRIPLE PANIC: makes `cargo build --target TRIPLE` possible and sets `cross_std`, the arguments that it needs. The
# target comes from rustup if it is installed there. Else the standard library is compiled from its source by the private
# toolchain: compiler and source are of one version, which -Z build-std needs, and RUSTC_BOOTSTRAP lets a stable compiler take -Z.
use_target() {
    cross_std=()
    if rustup target list --installed 2>/dev/null | grep -qx "$1" && [[ ${JOSTLE_CROSS:-rustup} == rustup ]]; then
        return
    fi
    make_private_toolchain
    export PATH="$cross_toolchain/bin:$PATH" RUSTC_BOOTSTRAP=1
    unset RUSTUP_TOOLCHAIN
    cross_std=(-Z "build-std=std,$2")
}

# has_target TRIPLE: whether use_target would work without installing anything.
has_target() {
    [[ -x $cross_toolchain/bin/cargo ]] || rustup target list --installed 2>/dev/null | grep -qx "$1"
}

make_private_toolchain() {
    [[ ! -x $cross_toolchain/bin/cargo ]] || return 0
    need apt-get "Without Debian's packages, install the target by: rustup target add"
    need dpkg "Install dpkg."
    say "unpacking the compiler with the source of its standard library into $cross_toolchain"
    local version tool deb folder="$cross_toolchain.partial"
    rm -rf "$folder"
    mkdir -p "$folder/debs" "$folder/bin"
    quietly "the libraries of the compiler could not be installed." "Run this as root, or: rustup target add" \
        apt-get install -y -qq --no-install-recommends libllvm22 lld-22 libgit2-1.5 libcurl4 libsqlite3-0 libssh2-1
    version="$(apt-cache policy rustc-web | sed -n 's/.*Candidate: \([0-9]*\.[0-9]*\)\..*/\1/p')"
    [[ -n $version ]] || fail "the package rustc-web is not known." "Install the target by: rustup target add"
    # libstd-rust-web-VERSION holds the compiler, libstd-rust-web-dev the library of this machine for build scripts.
    (cd "$folder/debs" && quietly "rustc-web could not be fetched." "Check the network and apt-get update." \
        apt-get download -qq rustc-web cargo-web rust-web-src libstd-rust-web-dev "libstd-rust-web-$version")
    for deb in "$folder"/debs/*.deb; do dpkg -x "$deb" "$folder"; done
    rm -rf "$folder/debs"
    # rustc finds its sysroot from where its library lies. Wrappers must not be written anew: cargo would compile all again.
    for tool in rustc cargo rustdoc; do
        printf '#!/bin/sh\nhere="$(dirname "$0")/.."\nLD_LIBRARY_PATH="$here/usr/lib/x86_64-linux-gnu" exec "$here/usr/bin/%s" "$@"\n' \
            "$tool" >"$folder/bin/$tool"
    done
    printf '#!/bin/sh\nexec wasm-ld-22 "$@"\n' >"$folder/bin/wasm-ld"
    chmod +x "$folder"/bin/*
    rm -rf "$cross_toolchain"
    mv "$folder" "$cross_toolchain"
}
