// What the browser remembers from visit to visit, where it is allowed to.

export function recall(key: string): string | null {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;  // site data is blocked
  }
}

export function store(key: string, value: string): void {
  try {
    localStorage.setItem(key, value);
  } catch {
    // Blocked: it is forgotten.
  }
}
