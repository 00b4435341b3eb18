export const CatalogueView = () => null;
