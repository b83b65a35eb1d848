export function Logo() {
  return (
    <svg width="26" height="26" viewBox="0 0 32 32" aria-hidden style={{ flex: "none" }}>
      <rect width="32" height="32" rx="7" fill="#0b6e6e" />
      <path
        d="M3 24h6c3 0 4-8 7-8s4 8 7 8h6"
        fill="none"
        stroke="#fff"
        strokeWidth="2.6"
        strokeLinecap="round"
        strokeLinejoin="round"
      />
      <circle cx="16" cy="9.5" r="4" fill="none" stroke="#fff" strokeWidth="2.6" />
    </svg>
  );
}
