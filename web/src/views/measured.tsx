export const MeasuredView = () => null;
